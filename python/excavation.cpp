#include "python/excavation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shared/field/brick.h"

namespace scree::python {

namespace {

/// The height of the highest rock of a column between two heights, in voxels; NaN: there is none.
float height_of_column(const Field& field, int x, int z, int lo_y, int hi_y) {
  int above = code_air;  // the code of the voxel above
  for (int y = hi_y - 1; y >= lo_y;) {
    const BrickCoord coord = brick_of(VoxelCoord{x, y, z});
    const VoxelCoord first = first_voxel(coord);
    const Brick& brick = field.brick(coord);
    for (; y >= std::max(lo_y, first.y); --y) {
      const int code = brick.codes[static_cast<size_t>(Brick::index(x - first.x, y - first.y, z - first.z))];
      if (code < 0)
        return static_cast<float>(y) +
               (y == hi_y - 1 ? 0.0F : static_cast<float>(-code) / static_cast<float>(above - code));
      above = code;
    }
  }
  return std::numeric_limits<float>::quiet_NaN();
}

int voxel_at(float place_m, float voxel_m) {
  return floor_to_int(place_m / voxel_m + 0.5F);
}

}  // namespace

void column_heights(const Field& field, const VoxelBox& box, int step, std::span<float> heights_m) {
  const float voxel_m = field.source().voxel_size_m;
  size_t i = 0;
  for (int x = box.lo.x; x < box.hi.x; x += step)
    for (int z = box.lo.z; z < box.hi.z; z += step)
      heights_m[i++] = voxel_m * height_of_column(field, x, z, box.lo.y, box.hi.y);
}

void observe(const Field& field, const Excavation& task, std::span<float> heights_m) {
  const float voxel_m = field.source().voxel_size_m;
  const int lo_y = voxel_at(task.floor_m, voxel_m), hi_y = voxel_at(task.top_m, voxel_m);
  const float cell_m = 2.0F * task.half_m / static_cast<float>(task.cells);
  size_t i = 0;
  for (int x = 0; x < task.cells; ++x)
    for (int z = 0; z < task.cells; ++z) {
      const float x_m = (static_cast<float>(x) + 0.5F) * cell_m - task.half_m;
      const float z_m = (static_cast<float>(z) + 0.5F) * cell_m - task.half_m;
      const float height =
          voxel_m * height_of_column(field, voxel_at(x_m, voxel_m), voxel_at(z_m, voxel_m), lo_y, hi_y);
      heights_m[i++] = std::isnan(height) ? task.floor_m : height;
    }
}

std::optional<Command> dig_at(const Field& field, const Excavation& task, std::span<const float, 3> action) {
  const float voxel_m = field.source().voxel_size_m;
  const float x_m = std::clamp(action[0], -task.half_m, task.half_m);
  const float z_m = std::clamp(action[1], -task.half_m, task.half_m);
  const float depth_m = std::clamp(action[2], 0.0F, task.depth_max_m);
  const float height = height_of_column(field, voxel_at(x_m, voxel_m), voxel_at(z_m, voxel_m),
                                        voxel_at(task.floor_m, voxel_m), voxel_at(task.top_m, voxel_m));
  if (std::isnan(height) || depth_m <= 0.0F) return std::nullopt;
  // The bucket's lowest place is so deep below the surface.
  const float low_m = voxel_m * height - depth_m + task.reach_m;
  const glm::vec3 low(x_m, low_m, z_m), high(x_m, std::max(voxel_m * height, low_m) + task.reach_m, z_m);
  return Command{.body = DigRequest{capsule(low, high, task.reach_m), 0, worlds_store()}};
}

}  // namespace scree::python
