#include "bench/peers/nano_terrain.h"

#include <nanovdb/util/HDDA.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <nanovdb/util/Ray.h>

#include "bench/peers/level_set.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree::peers {

struct NanoTerrain::Grid {
  nanovdb::GridHandle<> handle;
  double convert_ms = 0.0;
};

NanoTerrain::NanoTerrain(const Field& field, const VoxelBox& box) : grid_(std::make_unique<Grid>()) {
  const openvdb::FloatGrid::Ptr level_set = level_set_of(field, box);
  Stopwatch stopwatch;
  grid_->handle = nanovdb::openToNanoVDB(*level_set);
  grid_->convert_ms = stopwatch.lap_ms();
  CHECK(grid_->handle.grid<float>() != nullptr);
}

NanoTerrain::~NanoTerrain() = default;

double NanoTerrain::convert_ms() const {
  return grid_->convert_ms;
}

std::span<const uint32_t> NanoTerrain::words() const {
  return {reinterpret_cast<const uint32_t*>(grid_->handle.data()), grid_->handle.size() / sizeof(uint32_t)};
}

void NanoTerrain::trace(glm::vec3 from, std::span<const glm::vec3> directions, std::span<float> along) const {
  CHECK_EQ(directions.size(), along.size());
  using Ray = nanovdb::Ray<float>;
  const nanovdb::FloatGrid& grid = *grid_->handle.grid<float>();
  auto accessor = grid.tree().getAccessor();
  const nanovdb::Vec3f eye(from.x, from.y, from.z);
  for (size_t i = 0; i < directions.size(); ++i) {
    const glm::vec3& to = directions[i];
    Ray ray(eye, nanovdb::Vec3f(to.x, to.y, to.z));
    nanovdb::Coord voxel;
    float value = 0.0F, time = 0.0F;
    along[i] = nanovdb::ZeroCrossing(ray, accessor, voxel, value, time) ? time : none;
  }
}

std::string NanoTerrain::version() {
  return std::to_string(NANOVDB_MAJOR_VERSION_NUMBER) + "." + std::to_string(NANOVDB_MINOR_VERSION_NUMBER) +
         "." + std::to_string(NANOVDB_PATCH_VERSION_NUMBER);
}

}  // namespace scree::peers
