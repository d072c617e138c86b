// What a world is made from. May come from a command line, a file or a recording: whoever takes one in asks
// validate().
#pragma once

#include "server/world/methods.h"
#include "server/world/service_limits.h"
#include "shared/base/result.h"
#include "shared/field/terrain.h"

namespace scree {

/// The table of settings (settings.h) names the members that may change while the world runs.
struct WorldConfig {
  TerrainSource terrain;
  uint32_t tick_rate_hz = 60;
  uint32_t pieces_max = 2000;  ///< alive at once; carves beyond are refused
  uint32_t memory_max_mb =
      4096;  ///< of the terrain and the program; edits beyond are refused (server/work/memory.h)
  /// At once; the tick's budget allows fewer. 0: nothing merges, and nothing freezes either.
  uint32_t merges_per_tick_max = 1000;
  Methods methods;
  ServiceLimits service;  ///< for the network; the simulation does not read it

  bool operator==(const WorldConfig&) const = default;
};

/// Refuses what the simulation cannot run with; the error names the limit (server/world/limits.h and
/// shared/base/limits.h) and the way out.
Result<void> validate(const WorldConfig& config);

}  // namespace scree
