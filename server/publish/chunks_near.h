// Which chunks of many lie near an eye.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "shared/base/limits.h"
#include "shared/field/chunk_distance.h"
#include "shared/field/coord.h"

namespace scree {

/// Keeps the `count` smallest, in order.
template <typename T>
void retain_nearest(std::vector<std::pair<float, T>>& candidates, size_t count) {
  const size_t retained = std::min(count, candidates.size());
  std::ranges::partial_sort(candidates, candidates.begin() + static_cast<std::ptrdiff_t>(retained));
  candidates.resize(retained);
}

/// Places of chunks within the radius, about, and a few beyond.
inline double places_near(float radius_m, float voxel_size_m) {
  const float side_m = static_cast<float>(chunk_size) * voxel_size_m;
  return std::pow(2.0 * radius_m / side_m + 3.0, 3.0);
}

/// Calls `visit` for each key of `chunks`, a map by ChunkCoord, that is within the radius, in any order.
/// Looks up the places within the radius where they are fewer than the chunks: a world may have many.
template <typename Chunks, typename Visit>
void for_each_chunk_near(const Chunks& chunks, glm::vec3 eye_m, float radius_m, float voxel_size_m,
                         Visit&& visit) {
  const auto near = [&](ChunkCoord chunk) {
    return distance_to_chunk_m(eye_m, chunk, voxel_size_m) <= radius_m;
  };
  const float side_m = static_cast<float>(chunk_size) * voxel_size_m;
  const double places = places_near(radius_m, voxel_size_m);
  const float far_m = std::max({std::abs(eye_m.x), std::abs(eye_m.y), std::abs(eye_m.z)}) + radius_m;
  if (places >= static_cast<double>(chunks.size()) || far_m > 2.0F * limits::world_half_width_m) {
    for (const auto& [chunk, unused] : chunks)
      if (near(chunk)) visit(chunk);
    return;
  }
  const glm::vec3 first = (eye_m - radius_m) / side_m, last = (eye_m + radius_m) / side_m;
  for (int z = floor_to_int(first.z) - 1; z <= floor_to_int(last.z) + 1; ++z)
    for (int y = floor_to_int(first.y) - 1; y <= floor_to_int(last.y) + 1; ++y)
      for (int x = floor_to_int(first.x) - 1; x <= floor_to_int(last.x) + 1; ++x)
        if (const ChunkCoord chunk{x, y, z}; near(chunk) && chunks.contains(chunk)) visit(chunk);
}

}  // namespace scree
