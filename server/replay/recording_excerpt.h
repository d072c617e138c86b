// Cuts a shorter recording out of one, which plays and verifies by itself. What happened is simulated again
// and compared with what was recorded, then the new file is verified.
//
// Bullet cannot be taken up in the middle of a movement (server/formats/world_value.h). So the new recording
// begins with the latest state before its first tick from which the simulation gives the recorded hashes.
// That is the state of a tick without pieces, or one that the recording has. The commands from there on are
// kept without their ticks.
#pragma once

#include <functional>
#include <string>

#include "server/store/recording_reader.h"

namespace scree {

struct ExcerptReport {
  Tick first = 0, last = 0;  ///< the ticks of the new recording
  Tick state = 0;            ///< the tick of the state with which it begins
  uint64_t bytes = 0;
};

/// Writes the ticks first … last, which the recording has, to a new file, which appears under its name when
/// it is whole. Refuses to overwrite. Calls `progress` with the part that is done.
Result<ExcerptReport> write_excerpt(RecordingReader& recording, const std::string& to, Tick first, Tick last,
                                    const GroundGiver& ground,
                                    const std::function<void(double)>& progress = {});

}  // namespace scree
