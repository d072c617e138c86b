#include "bench/peers/stock_fracture.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>

#include "bench/peers/voro_cells.h"
#include "shared/base/timing.h"

namespace scree::peers {

namespace {

using openvdb::FloatGrid;

struct Mesh {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
};

openvdb::math::Transform::Ptr transform_of(float voxel_size_m) {
  return openvdb::math::Transform::createLinearTransform(voxel_size_m);
}

/// A cell as a closed mesh of triangles.
Mesh mesh_of(const VoroCell& cell) {
  Mesh mesh;
  for (size_t i = 0; i + 2 < cell.corners.size(); i += 3)
    mesh.points.emplace_back(static_cast<float>(cell.corners[i]), static_cast<float>(cell.corners[i + 1]),
                             static_cast<float>(cell.corners[i + 2]));
  const std::vector<int>& faces = cell.faces;
  for (size_t i = 0; i < faces.size(); i += static_cast<size_t>(faces[i]) + 1)
    for (size_t k = 2; k < static_cast<size_t>(faces[i]); ++k)
      mesh.triangles.emplace_back(faces[i + 1], faces[i + k], faces[i + k + 1]);
  return mesh;
}

}  // namespace

struct StockTerrain::Grids {
  float voxel_size_m = 0.0F;
  FloatGrid::Ptr terrain;
  glm::vec3 centre_m{0.0F};
  std::vector<Mesh> pieces;
};

StockTerrain::StockTerrain(const Field& field, const VoxelBox& box) : grids_(std::make_unique<Grids>()) {
  openvdb::initialize();
  const float dx = field.source().voxel_size_m;
  grids_->voxel_size_m = dx;
  grids_->terrain = FloatGrid::create(band_voxels * dx);
  grids_->terrain->setTransform(transform_of(dx));
  grids_->terrain->setGridClass(openvdb::GRID_LEVEL_SET);
  auto accessor = grids_->terrain->getAccessor();
  const Window window = gather(field, box);
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) {
        const Code code = window.at(x, y, z);
        const openvdb::Coord at(x, y, z);
        if (code == code_air) continue;
        if (code == code_solid)
          accessor.setValueOff(at, -band_voxels * dx);
        else
          accessor.setValue(at, decode(code) * dx);
      }
  grids_->terrain->pruneGrid();
}

StockTerrain::~StockTerrain() = default;

BreakTimes StockTerrain::carve(glm::vec3 centre_m, float radius_m, const std::vector<glm::vec3>& seeds_m) {
  const float dx = grids_->voxel_size_m;
  BreakTimes times;
  Stopwatch stopwatch;
  const openvdb::Vec3f centre(centre_m.x, centre_m.y, centre_m.z);
  FloatGrid::Ptr ball = openvdb::tools::createLevelSetSphere<FloatGrid>(radius_m, centre, dx, band_voxels);
  FloatGrid::Ptr volume = openvdb::tools::csgIntersectionCopy(*grids_->terrain, *ball);
  times.extract_ms = stopwatch.lap_ms();
  openvdb::tools::csgDifference(*grids_->terrain, *ball);
  times.carve_ms = stopwatch.lap_ms();
  std::vector<Mesh> cells;
  for (const VoroCell& cell : voro_cells(centre_m - radius_m, centre_m + radius_m, seeds_m))
    cells.push_back(mesh_of(cell));
  times.cells_ms = stopwatch.lap_ms();
  grids_->pieces.clear();
  grids_->centre_m = centre_m;
  for (const Mesh& cell : cells) {
    stopwatch.lap_ms();
    FloatGrid::Ptr solid = openvdb::tools::meshToLevelSet<FloatGrid>(*transform_of(dx), cell.points,
                                                                     cell.triangles, band_voxels);
    times.cells_ms += stopwatch.lap_ms();
    FloatGrid::Ptr piece = openvdb::tools::csgIntersectionCopy(*volume, *solid);
    times.cut_ms += stopwatch.lap_ms();
    Mesh mesh;
    openvdb::tools::volumeToMesh(*piece, mesh.points, mesh.quads);
    times.mesh_ms += stopwatch.lap_ms();
    if (!mesh.quads.empty()) grids_->pieces.push_back(std::move(mesh));
  }
  times.pieces = grids_->pieces.size();
  return times;
}

MergeTimes StockTerrain::merge(const std::vector<Pose>& poses) {
  MergeTimes times;
  for (size_t i = 0; i < poses.size() && i < grids_->pieces.size(); ++i) {
    Mesh mesh = grids_->pieces[i];
    for (openvdb::Vec3s& point : mesh.points) {
      const glm::vec3 at =
          poses[i].rotation * (glm::vec3(point.x(), point.y(), point.z()) - grids_->centre_m) +
          poses[i].position_m;
      point = openvdb::Vec3s(at.x, at.y, at.z);
    }
    Stopwatch stopwatch;
    FloatGrid::Ptr piece = openvdb::tools::meshToLevelSet<FloatGrid>(*transform_of(grids_->voxel_size_m),
                                                                     mesh.points, mesh.quads, band_voxels);
    times.volume_ms += stopwatch.lap_ms();
    openvdb::tools::csgUnion(*grids_->terrain, *piece);
    times.unite_ms += stopwatch.lap_ms();
    ++times.pieces;
  }
  return times;
}

}  // namespace scree::peers
