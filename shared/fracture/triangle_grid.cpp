#include "shared/fracture/triangle_grid.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {

namespace {

/// Side of a block, voxels: a cell of a carve into 64 touches about eight.
constexpr double grid_block_side = 4.0;

}  // namespace

TriangleGrid::TriangleGrid(const PolygonMesh& mesh) : mesh_(mesh), bounds_(bounds_of(mesh)) {
  if (mesh.empty()) return;
  size_ = blocks_of(bounds_).hi + VoxelCoord{1, 1, 1};
  blocks_.resize(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y) * static_cast<size_t>(size_.z));
  for (uint32_t i = 0; i < mesh.faces.size(); ++i) {
    const PolygonFace& face = mesh.faces[i];
    PolygonBounds bounds;
    for (uint32_t k = 0; k < face.edges; ++k) bounds.add(mesh.vertices[mesh.edges[face.first_edge + k].from]);
    const Blocks own = blocks_of(bounds);
    for (int x = own.lo.x; x <= own.hi.x; ++x)
      for (int y = own.lo.y; y <= own.hi.y; ++y)
        for (int z = own.lo.z; z <= own.hi.z; ++z)
          blocks_[static_cast<size_t>((x * size_.y + y) * size_.z + z)].push_back(i);
  }
}

TriangleGrid::Blocks TriangleGrid::blocks_of(const PolygonBounds& bounds) const {
  const auto block = [](double x, double lo, double hi) {
    const double within = std::clamp(x, lo, hi);
    return static_cast<int>((within - lo) / grid_block_side);
  };
  const glm::dvec3 &lo = bounds_.lo, &hi = bounds_.hi;
  return {{block(bounds.lo.x, lo.x, hi.x), block(bounds.lo.y, lo.y, hi.y), block(bounds.lo.z, lo.z, hi.z)},
          {block(bounds.hi.x, lo.x, hi.x), block(bounds.hi.y, lo.y, hi.y), block(bounds.hi.z, lo.z, hi.z)}};
}

const std::vector<uint32_t>& TriangleGrid::block(int x, int y, int z) const {
  CHECK_DEBUG(x >= 0 && y >= 0 && z >= 0 && x < size_.x && y < size_.y && z < size_.z);
  return blocks_[static_cast<size_t>((x * size_.y + y) * size_.z + z)];
}

std::vector<uint32_t> TriangleGrid::near(const PolygonBounds& bounds) const {
  std::vector<uint32_t> found;
  if (mesh_.empty()) return found;
  const Blocks around = blocks_of(bounds);
  for (int x = around.lo.x; x <= around.hi.x; ++x)
    for (int y = around.lo.y; y <= around.hi.y; ++y)
      for (int z = around.lo.z; z <= around.hi.z; ++z) {
        const std::vector<uint32_t>& here = block(x, y, z);
        found.insert(found.end(), here.begin(), here.end());
      }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// +1 where the ray from p along z leaves through the face, −1 where it enters.
int TriangleGrid::winding_above(glm::dvec3 p, const PolygonFace& face) const {
  int winding = 0;
  for (uint32_t k = 0; k < face.edges; ++k) {
    const PolygonEdge edge = mesh_.edges[face.first_edge + k];
    const glm::dvec3 &from = mesh_.vertices[edge.from], &to = mesh_.vertices[edge.to];
    if ((from.y <= p.y) == (to.y <= p.y)) continue;
    const bool climbs = to.y > from.y;
    const glm::dvec3 &low = climbs ? from : to, &high = climbs ? to : from;
    const double x = low.x + (high.x - low.x) * ((p.y - low.y) / (high.y - low.y));
    if (x > p.x) winding += climbs ? 1 : -1;
  }
  if (winding == 0) return 0;
  // Above the face's plane on the side that its normal points to: the face is below.
  const bool below = (face.plane.normal.z > 0.0) == (face.plane.distance(p) > 0.0);
  return below ? 0 : winding;
}

bool TriangleGrid::holds(glm::dvec3 p) const {
  if (mesh_.empty()) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < bounds_.lo[axis] || p[axis] > bounds_.hi[axis]) return false;
  PolygonBounds column;
  column.add(p);
  column.add(glm::dvec3(p.x, p.y, bounds_.hi.z));
  int winding = 0;
  for (const uint32_t face : near(column)) winding += winding_above(p, mesh_.faces[face]);
  return winding > 0;
}

}  // namespace scree
