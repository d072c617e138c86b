// A world of flat ground.
#pragma once

#include "server/world/world_config.h"
#include "tests/support/flat_terrain.h"

namespace scree {

inline WorldConfig flat_world() {
  WorldConfig config;
  config.terrain = flat_terrain;
  return config;
}

}  // namespace scree
