// A voxel's coordinates as a vector: its place in a space whose unit is the voxel.
#pragma once

#include <glm/vec3.hpp>

#include "shared/field/coord.h"

namespace scree {

inline glm::vec3 as_vector(VoxelCoord v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace scree
