// The measure of interest: how far an eye is from a chunk.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "shared/field/coord.h"

namespace scree {

/// Distance to the chunk's nearest point, metres; 0 inside.
inline float distance_to_chunk_m(glm::vec3 eye_m, ChunkCoord chunk, float voxel_size_m) {
  const float side_m = static_cast<float>(chunk_size) * voxel_size_m;
  const glm::vec3 lo = glm::vec3(chunk.x, chunk.y, chunk.z) * side_m;
  return glm::length(glm::clamp(eye_m, lo, lo + side_m) - eye_m);
}

}  // namespace scree
