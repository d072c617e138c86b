// Distances of a field between its voxels.
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/base/check.h"
#include "shared/field/field.h"

namespace scree {

FieldSample sample(const Field& field, glm::vec3 p_voxels) {
  const VoxelCoord v{floor_to_int(p_voxels.x), floor_to_int(p_voxels.y), floor_to_int(p_voxels.z)};
  const float fx = p_voxels.x - static_cast<float>(v.x);
  const float fy = p_voxels.y - static_cast<float>(v.y);
  const float fz = p_voxels.z - static_cast<float>(v.z);
  float c[8];
  const BrickCoord home = brick_of(v);
  const VoxelCoord in{v.x & 7, v.y & 7, v.z & 7};
  if (in.x < 7 && in.y < 7 && in.z < 7) {
    const Brick& brick = field.brick(home);
    for (int i = 0; i < 8; ++i)
      c[i] = brick.codes[static_cast<size_t>(
          Brick::index(in.x + (i >> 2), in.y + ((i >> 1) & 1), in.z + (i & 1)))];
  } else {
    for (int i = 0; i < 8; ++i) {
      const VoxelCoord at{v.x + (i >> 2), v.y + ((i >> 1) & 1), v.z + (i & 1)};
      c[i] = field.brick(brick_of(at)).codes[static_cast<size_t>(Brick::index(at.x & 7, at.y & 7, at.z & 7))];
    }
  }
  const float x00 = c[0] + (c[4] - c[0]) * fx, x01 = c[1] + (c[5] - c[1]) * fx;
  const float x10 = c[2] + (c[6] - c[2]) * fx, x11 = c[3] + (c[7] - c[3]) * fx;
  const float y0 = x00 + (x10 - x00) * fy, y1 = x01 + (x11 - x01) * fy;
  const float low_x = (c[4] - c[0]) * (1 - fy) + (c[6] - c[2]) * fy;
  const float high_x = (c[5] - c[1]) * (1 - fy) + (c[7] - c[3]) * fy;
  const float scale = band_voxels / 127.0F;
  return {
      (y0 + (y1 - y0) * fz) * scale,
      glm::vec3(low_x + (high_x - low_x) * fz, (x10 - x00) * (1 - fz) + (x11 - x01) * fz, y1 - y0) * scale};
}

std::optional<float> trace(const Field& field, glm::vec3 from_voxels, glm::vec3 direction,
                           float distance_max_voxels) {
  constexpr float close_enough = 0.02F;
  CHECK(std::abs(glm::dot(direction, direction) - 1.0F) < 1e-3F);
  float along = 0.0F;
  while (along <= distance_max_voxels) {
    const float distance = sample(field, from_voxels + direction * along).distance_voxels;
    if (distance < close_enough) return along;
    along += distance * 0.9F;
  }
  return std::nullopt;
}

}  // namespace scree
