// Files of worlds made of a recording: a new one, or an earlier one in the place of what the world became.
#pragma once

#include <optional>
#include <string>

#include "server/world/world_config.h"
#include "shared/base/ids.h"

namespace scree {

struct PastWorld {
  Tick tick = 0;
  std::string before;  ///< file of what the world was until then; empty for a new one
};

/// Makes a new file of the world after a tick of the recording, by default its last. The ticks up to there
/// are simulated again, and their hashes compared.
Result<PastWorld> world_of_recording(const std::string& path, const std::string& recording,
                                     std::optional<Tick> tick, const GroundGiver& ground);

/// Replaces a world that no server has by the one of that tick in its recording, at once or not at all. What
/// it was stays as a file beside it. Refuses the recording of another world. The recording may go on from
/// there: a server drops its later ticks.
Result<PastWorld> roll_back(const std::string& path, const std::string& recording, Tick tick,
                            const GroundGiver& ground);

}  // namespace scree
