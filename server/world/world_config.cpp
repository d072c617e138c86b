#include "server/world/world_config.h"

#include <cstdio>
#include <string>
#include <tuple>

#include "server/work/limits.h"
#include "server/world/limits.h"
#include "server/world/settings.h"
#include "shared/base/limits.h"
#include "shared/operation/store_limits.h"

namespace scree {

namespace {

struct Bounded {
  double value, min, max;
  const char* name;
  const char* limits;  ///< their names
  const char* option;  ///< of the server
};

/// Six digits: bounds are doubles of floats.
std::string rounded_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

/// What is not a number is not within.
Result<void> check(const Bounded& bounded) {
  if (bounded.value >= bounded.min && bounded.value <= bounded.max) return {};
  return fail(std::string(bounded.name) + " is " + rounded_text(bounded.value) + ", not within " +
              rounded_text(bounded.min) + " to " + rounded_text(bounded.max) + " (" + bounded.limits +
              "): choose another (" + bounded.option + ")");
}

/// What of stores may be asked for.
Result<void> check_stores(const WorldConfig& config) {
  TRY(check({.value = static_cast<double>(config.store_m3),
             .min = 0.0,
             .max = limits::store_max_m3,
             .name = "store_m3",
             .limits = "limits.store_max_m3",
             .option = "--store-m3"}));
  return check({.value = static_cast<double>(config.dig_m3_per_s),
                .min = 0.0,
                .max = limits::dig_max_m3_per_s,
                .name = "dig_m3_per_s",
                .limits = "limits.dig_max_m3_per_s",
                .option = "--dig-m3-per-s"});
}

/// What is rubble follows from the palette and the rules.
TerrainSource without_rubble(TerrainSource source) {
  source.rubble = Rubble();
  return source;
}

}  // namespace

bool WorldConfig::operator==(const WorldConfig& other) const {
  const auto tied = [](const WorldConfig& c) {
    return std::tie(c.tick_rate_hz, c.pieces_max, c.props_max, c.joints_max, c.memory_max_mb,
                    c.merges_per_tick_max, c.work_percent, c.store_m3, c.dig_m3_per_s, c.air_drag_percent,
                    c.methods, c.service, c.spawn, c.water, c.ground, c.rules, *c.palette,
                    c.material_numbers);
  };
  return tied(*this) == tied(other) && without_rubble(terrain) == without_rubble(other.terrain);
}

Result<void> validate(const WorldConfig& config) {
  if (config.terrain.rows != config.palette->ground)
    return fail("the terrain's layers are not those of the palette's ground");
  TRY(validate_kind(config.terrain.kind, "kind of terrain"));
  const Bounded all[] = {
      {.value = config.terrain.voxel_size_m,
       .min = limits::voxel_size_min_m,
       .max = limits::voxel_size_max_m,
       .name = "voxel_size_m",
       .limits = "limits.voxel_size_min_m, voxel_size_max_m",
       .option = "--voxel-size"},
      {.value = static_cast<double>(config.tick_rate_hz),
       .min = limits::tick_rate_min_hz,
       .max = limits::tick_rate_max_hz,
       .name = "tick_rate_hz",
       .limits = "limits.tick_rate_min_hz, tick_rate_max_hz",
       .option = "--tick-rate"},
      {.value = static_cast<double>(config.pieces_max),
       .min = limits::pieces_max_min,
       .max = limits::pieces_max_max,
       .name = "pieces_max",
       .limits = "limits.pieces_max_min, pieces_max_max",
       .option = "--pieces-max"},
      {.value = static_cast<double>(config.props_max),
       .min = 0.0,
       .max = limits::props_max_max,
       .name = "props_max",
       .limits = "limits.props_max_max",
       .option = "--props-max"},
      {.value = static_cast<double>(config.joints_max),
       .min = 0.0,
       .max = limits::joints_max_max,
       .name = "joints_max",
       .limits = "limits.joints_max_max",
       .option = "--joints-max"},
      {.value = static_cast<double>(config.memory_max_mb),
       .min = limits::memory_max_min_mb,
       .max = limits::memory_max_max_mb,
       .name = "memory_max_mb",
       .limits = "limits.memory_max_min_mb, memory_max_max_mb",
       .option = "--memory-max"},
      {.value = static_cast<double>(config.work_percent),
       .min = limits::work_percent_min,
       .max = limits::work_percent_max,
       .name = "work_percent",
       .limits = "limits.work_percent_min, work_percent_max",
       .option = "--work-percent"},
      {.value = static_cast<double>(config.air_drag_percent),
       .min = 0.0,
       .max = limits::air_drag_max_percent,
       .name = "air_drag_percent",
       .limits = "limits.air_drag_max_percent",
       .option = "--air-drag"},
      {.value = static_cast<double>(config.merges_per_tick_max),
       .min = 0.0,
       .max = limits::merges_per_tick_max_max,
       .name = "merges_per_tick_max",
       .limits = "limits.merges_per_tick_max_max",
       .option = "WorldConfig"},
  };
  for (const Bounded& bounded : all) TRY(check(bounded));
  TRY(check_stores(config));
  return check_together(config);
}

Result<void> check_ground(const WorldConfig& config) {
  if (config.ground == Digest{} || config.terrain.heights != nullptr) return {};
  return fail("its ground " + hex_of(config.ground) + " is not there");
}

bool is_same_terrain(const WorldConfig& a, const WorldConfig& b) {
  if (a.ground != b.ground || a.terrain.voxel_size_m != b.terrain.voxel_size_m) return false;
  return a.ground != Digest{} || without_rubble(a.terrain) == without_rubble(b.terrain);
}

Result<void> give_ground(const Digest& ground, TerrainSource& terrain, const GroundGiver& give) {
  if (ground == Digest{}) return {};
  if (!give) return fail("its ground " + hex_of(ground) + " is not there");
  return give(ground, terrain);
}

}  // namespace scree
