#include "bench/peers/level_set.h"

#include <openvdb/tools/SignedFloodFill.h>

namespace scree::peers {

openvdb::FloatGrid::Ptr level_set_of(const Field& field, const VoxelBox& box) {
  openvdb::initialize();
  const float dx = field.source().voxel_size_m;
  const float background_m = band_voxels * dx;
  auto grid = openvdb::FloatGrid::create(background_m);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(dx));
  for_each_brick(box, [&](BrickCoord coord) {
    const Brick& brick = field.brick(coord);
    if (uniform_equivalent(brick) != nullptr) return;
    const VoxelCoord first = first_voxel(coord);
    auto* leaf = grid->tree().touchLeaf({first.x, first.y, first.z});
    for (openvdb::Index i = 0; i < brick_voxels; ++i) {
      const Code code = brick.codes[i];
      const bool in_band = code > code_solid && code < code_air;
      leaf->setValueOnly(i, decode(code) * dx);
      leaf->setActiveState(i, in_band);
    }
  });
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

}  // namespace scree::peers
