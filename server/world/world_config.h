// What a world is made from. May come from a command line, a file or a recording: the code that reads one
// calls validate().
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "content/builtin_palette.h"
#include "server/world/material_settings.h"
#include "server/world/methods.h"
#include "server/world/rules.h"
#include "server/world/service_limits.h"
#include "shared/base/digest.h"
#include "shared/base/result.h"
#include "shared/base/spawn.h"
#include "shared/base/water.h"
#include "shared/field/terrain.h"

namespace scree {

/// The table of settings (settings.h) names the members that may change while the world runs.
struct WorldConfig {
  TerrainSource terrain;
  uint32_t tick_rate_hz = 60;
  uint32_t pieces_max = 2000;  ///< alive at once; carves beyond are refused
  uint32_t props_max = 1000;   ///< there at once; more are refused
  uint32_t joints_max = 1000;  ///< likewise
  uint32_t memory_max_mb =
      4096;  ///< of the terrain and the program; the server keeps to it (server/app/terrain_pager.h)
  /// At once; the tick's budget allows fewer. 0: nothing merges, and nothing freezes either.
  uint32_t merges_per_tick_max = 1000;
  /// Percent of a tick's length that its work may take by the model (server/work/work.h). A live server
  /// lowers it while its ticks are late, and raises it again (server/app/load_governor.h).
  uint32_t work_percent = 65;
  uint32_t store_m3 = 1000;       ///< rock that a person's store holds; 0: nothing, so that nobody digs
  uint32_t dig_m3_per_s = 50;     ///< into each store; 0: as much as one likes
  uint32_t air_drag_percent = 0;  ///< of their speed and spin, which pieces lose to the air in a second
  Methods methods;
  ServiceLimits service;           ///< for the network; the simulation does not read it
  std::optional<Spawn> spawn{};    ///< where visitors begin; nothing: where the ground suggests (SpawnPlace)
  WaterLevel water{};              ///< for clients, which draw it; the simulation does not read it
  Digest ground{};                 ///< names the file that terrain.heights is from; zeros: of no file
  uint32_t rules = rules::newest;  ///< of service (rules.h); fixed from the start
  /// What the world is made of, to start with; not null. `terrain.rows` are its ground's.
  std::shared_ptr<const Palette> palette = shared_builtin_palette();
  MaterialNumbers material_numbers{};  ///< that an administrator has changed of it

  bool operator==(const WorldConfig& other) const;
};

/// Share of their speed that pieces lose to the air in a second.
inline float drag_of(const WorldConfig& config) {
  return 0.01F * static_cast<float>(config.air_drag_percent);
}

/// Refuses what the simulation cannot run with; the error names the limit (server/world/limits.h and
/// shared/base/limits.h) and the way out.
Result<void> validate(const WorldConfig& config);

/// Refuses a terrain that is named but not there: a file names its ground, and its reader has to find that
/// first.
Result<void> check_ground(const WorldConfig& config);
/// Whether both are of one terrain; grounds of files are compared by their names.
bool is_same_terrain(const WorldConfig& a, const WorldConfig& b);

/// Gives the terrain the ground of that name, from wherever this program finds grounds.
using GroundGiver = std::function<Result<void>(const Digest& ground, TerrainSource& terrain)>;
/// As `give`, where a ground is named; an error if there is none to ask.
Result<void> give_ground(const Digest& ground, TerrainSource& terrain, const GroundGiver& give);

}  // namespace scree
