#include "shared/field/paint.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {

namespace {

VoxelCoord voxel_at(glm::vec3 p_voxels) {
  return {floor_to_int(p_voxels.x + 0.5F), floor_to_int(p_voxels.y + 0.5F), floor_to_int(p_voxels.z + 0.5F)};
}

}  // namespace

std::vector<BrickCoord> bricks_of(const Shape& shape_voxels) {
  constexpr float half = 0.5F * static_cast<float>(brick_size - 1);
  const BrickCoord middle = brick_of(voxel_at(centre_of(shape_voxels)));
  std::vector<BrickCoord> bricks;
  for_each_brick(band_box(shape_voxels), [&](BrickCoord brick) {
    const VoxelCoord first = first_voxel(brick);
    const glm::vec3 centre = glm::vec3(first.x, first.y, first.z) + half;
    if (brick == middle || distance(shape_voxels, centre) <= 0.0F) bricks.push_back(brick);
  });
  CHECK(std::ranges::binary_search(bricks, middle));
  return bricks;
}

VoxelBox paint_box(const Shape& shape_voxels) {
  const std::vector<BrickCoord> bricks = bricks_of(shape_voxels);
  VoxelBox box{first_voxel(bricks.front()), first_voxel(bricks.front())};
  for (const BrickCoord brick : bricks) {
    const VoxelCoord lo = first_voxel(brick), hi = lo + VoxelCoord{brick_size, brick_size, brick_size};
    box.lo = {std::min(box.lo.x, lo.x), std::min(box.lo.y, lo.y), std::min(box.lo.z, lo.z)};
    box.hi = {std::max(box.hi.x, hi.x), std::max(box.hi.y, hi.y), std::max(box.hi.z, hi.z)};
  }
  return box;
}

std::vector<BrickCoord> paint_bricks(Field& field, const Shape& shape_voxels, Material material) {
  std::vector<BrickCoord> changed;
  for (const BrickCoord brick : bricks_of(shape_voxels)) {
    const BrickMaterials painted(said(material));
    if (field.materials(brick) == painted) continue;
    field.set_materials(brick, painted);
    changed.push_back(brick);
  }
  return changed;
}

}  // namespace scree
