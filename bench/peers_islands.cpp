#include "bench/peers_islands.h"

#include <algorithm>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/SignedFloodFill.h>

#include "shared/base/timing.h"

namespace scree {

namespace {

/// Leaves where the surface is; what is solid without one is filled in from them.
openvdb::FloatGrid::Ptr level_set_of(Field& field, const VoxelBox& box) {
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

}  // namespace

PeerSegments segment_with_openvdb(Field& field, const VoxelBox& box) {
  openvdb::initialize();
  const openvdb::FloatGrid::Ptr grid = level_set_of(field, box);
  std::vector<openvdb::FloatGrid::Ptr> segments;
  PeerSegments peer;
  peer.leaves = grid->tree().leafCount();
  Stopwatch watch;
  openvdb::tools::segmentSDF(*grid, segments);
  peer.milliseconds = watch.lap_ms();
  peer.segments = segments.size();
  return peer;
}

}  // namespace scree
