// The welcome of a server whose ground is flat.
#pragma once

#include "proto/messages.h"
#include "tests/support/flat_terrain.h"

namespace scree {

inline WelcomeMessage flat_welcome(float voxel_size_m = voxel_m) {
  WelcomeMessage message;
  message.terrain = terrain_of_worlds(flat_terrain);
  message.terrain.voxel_size_m = voxel_size_m;
  message.interest_radius_m = 64.0F;
  return message;
}

}  // namespace scree
