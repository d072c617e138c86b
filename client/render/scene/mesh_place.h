// The place of a mesh, such that adjoining meshes have bit-identical vertices along their border.
#pragma once

#include <glm/vec3.hpp>

#include "shared/surface/surface_mesh.h"

namespace scree {

/// Vertices lie at (origin + position · step) voxels of the finest level. Exact in floats: only the product
/// with a voxel's size is rounded (client/shaders/surface.vert), and that of equal numbers.
struct MeshPlace {
  glm::vec3 origin;
  float step;
};

/// The place of a mesh in samples of the level.
inline MeshPlace place_of(VoxelCoord origin, int level) {
  const auto side = static_cast<float>(1 << level);
  const glm::vec3 at(static_cast<float>(origin.x), static_cast<float>(origin.y),
                     static_cast<float>(origin.z));
  return {at * side, side / surface_steps_per_voxel};
}

}  // namespace scree
