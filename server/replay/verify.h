// Verifies a recording: simulates again from its commands, and compares the hashes and the events of
// every tick; events of the machine do not follow from the commands, and are not compared. Where
// another process went on with the recording, or a part of it begins, the whole state is compared with the
// one that is recorded, and the simulation begins anew from that. Ticks before the first one, of which there
// are commands alone, are simulated and not counted.
#pragma once

#include <functional>
#include <string>

#include "server/store/limits.h"
#include "server/store/recording_reader.h"

namespace scree {

struct VerifyReport {
  Tick ticks = 0;             ///< ticks that were compared
  uint64_t commands = 0;      ///< commands that were simulated
  uint64_t events = 0;        ///< of the world, that were compared
  uint64_t restarts = 0;      ///< times that the simulation began anew, from a state that was compared, too
  Tick first_difference = 0;  ///< 0: every tick agrees
  std::string difference;     ///< the two hashes that differ there
  uint64_t field_hash = 0;    ///< after the last tick that was simulated
  uint64_t state_hash = 0;
  double seconds = 0.0;

  bool agrees() const { return first_difference == 0; }
};

/// Ends at the first tick that differs. Calls `progress(done, all)` every 32 ticks. A recording that cannot
/// be read is an error, and so is one whose ground `ground` does not give. Has about `bricks_max` edited
/// bricks in memory, however large the world is, where its terrain is recorded chunk by chunk.
Result<VerifyReport> verify(RecordingReader& recording, const std::function<void(Tick, Tick)>& progress = {},
                            const GroundGiver& ground = {}, size_t bricks_max = limits::simulated_bricks_max);

}  // namespace scree
