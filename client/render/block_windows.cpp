#include "client/render/block_windows.h"

#include <algorithm>

namespace scree {

std::optional<BlockWindows> gather_windows(Field& field, const VoxelBox& owned) {
  const VoxelBox box = owned.grown(surface_nets_apron);
  bool air = true;
  bool rock = true;
  bool edited = false;
  for_each_brick(box, [&](BrickCoord coord) {
    const Brick* brick = &field.brick(coord);
    air = air && brick == &air_brick();
    rock = rock && brick == &solid_brick();
    edited = edited || field.is_edited(coord);
  });
  if (air || rock) return std::nullopt;
  BlockWindows windows{owned, gather(field, box), std::nullopt};
  if (edited) windows.before = gather_generated(field, box);
  return windows;
}

Window gather_generated(Field& field, const VoxelBox& box) {
  Window window(box);
  for_each_brick(box, [&](BrickCoord coord) {
    const Brick& brick = field.generated_brick(coord);
    const VoxelCoord first = first_voxel(coord);
    const VoxelCoord lo{std::max(first.x, box.lo.x), std::max(first.y, box.lo.y),
                        std::max(first.z, box.lo.z)};
    const VoxelCoord hi{std::min(first.x + brick_size, box.hi.x), std::min(first.y + brick_size, box.hi.y),
                        std::min(first.z + brick_size, box.hi.z)};
    for (int x = lo.x; x < hi.x; ++x)
      for (int y = lo.y; y < hi.y; ++y)
        std::copy_n(&brick.codes[static_cast<size_t>(Brick::index(x - first.x, y - first.y, lo.z - first.z))],
                    hi.z - lo.z, &window.at(x, y, lo.z));
  });
  return window;
}

}  // namespace scree
