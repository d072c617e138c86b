// Ground of noise with many carves and fills in it, without a simulation: for questions about space.
#pragma once

#include "shared/base/random.h"
#include "shared/field/edit.h"
#include "shared/field/field.h"

namespace scree {

/// Carves and fills shapes of every kind in a cube about a place on the ground, metres.
inline void roughen(Field& field, glm::vec3 middle_m, float half_m, int edits, uint64_t random_seed) {
  Random random(random_seed);
  const float voxel_m = field.source().voxel_size_m;
  // In braces, arguments are computed in their order.
  const auto any = [&](float half) {
    const auto part = [&] { return (random.unit() * 2.0F - 1.0F) * half; };
    return glm::vec3{part(), part(), part()};
  };
  for (int i = 0; i < edits; ++i) {
    const glm::vec3 at = middle_m + any(half_m);
    const float size_m = voxel_m * (2.0F + random.unit() * 6.0F);
    Shape shape = sphere(at, size_m);
    if (i % 4 == 1) shape = box(at, glm::vec3(1.0F, 0.6F, 1.3F) * size_m);
    if (i % 4 == 2) shape = capsule(at, at + any(half_m * 0.1F), size_m);
    if (i % 4 == 3) shape = crater(at, size_m * 1.5F);
    const Shape in_grid = in_voxels(shape, voxel_m);
    Window window = gather(field, band_box(in_grid));
    const Window codes = codes_of(in_grid, window.box);
    if (i % 3 == 2)
      fill(window, codes);
    else
      carve(window, codes);
    scatter(field, window);
  }
}

}  // namespace scree
