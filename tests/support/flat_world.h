// A world of flat ground.
#pragma once

#include <memory>

#include "server/world/world_config.h"
#include "tests/support/flat_terrain.h"

namespace scree {

inline WorldConfig flat_world() {
  WorldConfig config;
  config.terrain = flat_terrain;
  return config;
}

/// The same of rock up to its surface: what stands on it stands firm.
inline WorldConfig rock_world() {
  auto palette = std::make_shared<Palette>(builtin_palette());
  palette->ground = rock_terrain.rows;
  WorldConfig config;
  config.terrain = rock_terrain;
  config.palette = std::move(palette);
  return config;
}

}  // namespace scree
