// Proves a recording: simulates again from its commands, and compares the hashes of every tick.
#pragma once

#include <functional>
#include <string>

#include "server/store/recording_reader.h"

namespace scree {

struct VerifyReport {
  Tick ticks = 0;             ///< compared
  uint64_t commands = 0;      ///< fed
  Tick first_difference = 0;  ///< 0: every tick agrees
  std::string difference;     ///< what differed there, and how
  uint64_t field_hash = 0;    ///< after the last tick that was simulated
  uint64_t state_hash = 0;
  double seconds = 0.0;

  bool agrees() const { return first_difference == 0; }
};

/// Ends at the first tick that differs. `progress(done, all)` is called now and then. An error: the recording
/// cannot be read.
Result<VerifyReport> verify(RecordingReader& recording, const std::function<void(Tick, Tick)>& progress = {});

}  // namespace scree
