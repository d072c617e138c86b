#include "bench/peers/segment_sdf.h"

#include <openvdb/tools/LevelSetUtil.h>

#include "bench/peers/level_set.h"
#include "shared/base/timing.h"

namespace scree {

PeerSegments segment_with_openvdb(const Field& field, const VoxelBox& box) {
  const openvdb::FloatGrid::Ptr grid = peers::level_set_of(field, box);
  std::vector<openvdb::FloatGrid::Ptr> segments;
  PeerSegments peer;
  peer.leaves = grid->tree().leafCount();
  Stopwatch stopwatch;
  openvdb::tools::segmentSDF(*grid, segments);
  peer.milliseconds = stopwatch.lap_ms();
  peer.segments = segments.size();
  return peer;
}

}  // namespace scree
