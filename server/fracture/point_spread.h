// Thins points out: by cubes of a grid, whose side grows until few enough are left. Deterministic; voxels.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/field/coord.h"

namespace scree {

/// Factor by which cubes and tolerances grow: about two thirds of the points stay each time.
inline constexpr float thinning_growth = 1.25F;

inline VoxelCoord cube_around(glm::vec3 p, float side) {
  return {floor_to_int(p.x / side), floor_to_int(p.y / side), floor_to_int(p.z / side)};
}

/// The first point in each cube of a grid, in their order. The cubes' side begins at `side_voxels` and grows
/// until at most `count_max` points are left. Both are positive.
std::vector<glm::vec3> spread(const std::vector<glm::vec3>& points, float side_voxels, size_t count_max);

}  // namespace scree
