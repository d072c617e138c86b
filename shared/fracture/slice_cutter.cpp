#include "shared/fracture/slice_cutter.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace scree {

namespace {

/// Distance from a group's cells at which its mesh is cropped, voxels: no cap of a crop then touches a cell.
constexpr double crop_margin = 0.5;

class Slicing {
 public:
  explicit Slicing(const std::vector<PolygonMesh>& cells) : cells_(cells), parts_(cells.size()) {
    for (const PolygonMesh& cell : cells) bounds_.push_back(bounds_of(cell));
  }

  std::vector<PolygonMesh> run(const PolygonMesh& mesh) {
    std::vector<uint32_t> order(cells_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::erase_if(order, [&](uint32_t i) { return cells_[i].empty(); });
    divide(mesh, order);
    return std::move(parts_);
  }

 private:
  void divide(PolygonMesh mesh, std::span<uint32_t> group) {
    if (mesh.empty() || group.empty()) return;
    if (group.size() == 1) {
      for (const PolygonFace& face : cells_[group.front()].faces)
        if (face.neighbour != own_surface) slicer_.slice(mesh, face.plane, face.neighbour);
      parts_[group.front()] = std::move(mesh);
      return;
    }
    const int axis = longest_axis(bounds(group));
    std::ranges::sort(group, [&](uint32_t a, uint32_t b) {
      const double at_a = bounds_[a].lo[axis] + bounds_[a].hi[axis];
      const double at_b = bounds_[b].lo[axis] + bounds_[b].hi[axis];
      return at_a != at_b ? at_a < at_b : a < b;
    });
    const std::span<uint32_t> low = group.first(group.size() / 2), high = group.subspan(group.size() / 2);
    divide(cropped(mesh, bounds(low)), low);
    divide(cropped(std::move(mesh), bounds(high)), high);
  }

  PolygonBounds bounds(std::span<const uint32_t> group) const {
    PolygonBounds all;
    for (const uint32_t i : group) all.add(bounds_[i]);
    return all;
  }

  static int longest_axis(const PolygonBounds& bounds) {
    const glm::dvec3 size = bounds.hi - bounds.lo;
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
  }

  PolygonMesh cropped(PolygonMesh mesh, const PolygonBounds& bounds) {
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 normal(0.0);
      normal[axis] = 1.0;
      slicer_.slice(mesh, {normal, bounds.hi[axis] + crop_margin}, own_surface);
      slicer_.slice(mesh, {-normal, crop_margin - bounds.lo[axis]}, own_surface);
    }
    return mesh;
  }

  const std::vector<PolygonMesh>& cells_;
  std::vector<PolygonBounds> bounds_;
  std::vector<PolygonMesh> parts_;
  Slicer slicer_;
};

}  // namespace

std::vector<PolygonMesh> slice_by_cells(const PolygonMesh& mesh, const std::vector<PolygonMesh>& cells) {
  return Slicing(cells).run(mesh);
}

Cut cut_by_slices(const Window& volume, std::vector<uint8_t> lost,
                  const std::vector<glm::vec3>& seeds_voxels) {
  return cut_as_polygons(slice_cutting, volume, std::move(lost), seeds_voxels);
}

}  // namespace scree
