#include "bench/peers/volume_to_mesh.h"

#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/global_control.h>

#include "bench/peers/level_set.h"

namespace scree::peers {

struct StockMesher::Grid {
  openvdb::FloatGrid::Ptr level_set;
};

StockMesher::StockMesher(const Field& field, const VoxelBox& box)
    : grid_(std::make_unique<Grid>(Grid{level_set_of(field, box)})) {}

StockMesher::~StockMesher() = default;

size_t StockMesher::mesh() const {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid_->level_set, points, quads);
  return quads.size();
}

}  // namespace scree::peers
