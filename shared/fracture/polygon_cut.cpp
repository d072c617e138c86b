#include "shared/fracture/polygon_cut.h"

#include <algorithm>
#include <numeric>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/fracture/cell_groups.h"
#include "shared/fracture/polygon_codes.h"
#include "shared/fracture/voronoi_cells.h"

namespace scree {

namespace {

/// Room between the whole and the box that bounds the cells, voxels: no cell's outer face touches the whole.
constexpr double cells_margin = 2.0;

/// Voxels that a piece's window reaches beyond its polygons: its surface, and room for gradients.
constexpr int window_margin = 2;

/// Faces smaller than this, voxels², are rounding's, and join no cells.
constexpr double touch_area = 1e-6;

double area_of(const PolygonMesh& mesh, const PolygonFace& face) {
  const glm::dvec3 tip = mesh.vertices[mesh.edges[face.first_edge].from];
  double area = 0.0;
  for (uint32_t i = face.first_edge; i < face.first_edge + face.edges; ++i) {
    const glm::dvec3 a = mesh.vertices[mesh.edges[i].from], b = mesh.vertices[mesh.edges[i].to];
    area += 0.5 * glm::dot(face.plane.normal, glm::cross(a - tip, b - tip));
  }
  return area;
}

/// Pairs of cells (low, high) whose parts share a face, sorted.
std::vector<std::pair<CellLabel, CellLabel>> touching_parts(const std::vector<PolygonMesh>& parts) {
  std::vector<std::pair<CellLabel, CellLabel>> pairs;
  for (size_t i = 0; i < parts.size(); ++i)
    for (const PolygonFace& face : parts[i].faces) {
      if (face.neighbour == own_surface || area_of(parts[i], face) < touch_area) continue;
      CHECK_DEBUG(face.neighbour < parts.size() && face.neighbour != i);
      const auto here = static_cast<CellLabel>(i), there = static_cast<CellLabel>(face.neighbour);
      pairs.emplace_back(std::min(here, there), std::max(here, there));
    }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// Shares `total` out in proportion to the volumes; as each share is the difference of two cumulative ones,
/// no unit is left over. Empty when there is no volume. A whole has at most 2^21 voxels and 2^29 units, so
/// products stay below 2^62.
std::vector<MassUnits> masses_by_volume(MassUnits total, const std::vector<PolygonMoments>& moments) {
  constexpr double shares_per_voxel = 1024.0;
  std::vector<int64_t> shares;
  for (const PolygonMoments& part : moments)
    shares.push_back(static_cast<int64_t>(std::max(part.volume, 0.0) * shares_per_voxel));
  const int64_t all = std::accumulate(shares.begin(), shares.end(), int64_t{0});
  CHECK(total >= 0 && total <= MassUnits{1} << 29U);
  CHECK_DEBUG(all < int64_t{1} << 33U);
  std::vector<MassUnits> masses;
  if (all == 0) return masses;
  int64_t before = 0;
  MassUnits given = 0;
  for (const int64_t share : shares) {
    before += share;
    const MassUnits due = total * before / all;
    masses.push_back(due - given);
    given = due;
  }
  return masses;
}

/// Makes pieces from the parts of a cut.
class PieceMaker {
 public:
  PieceMaker(bool closed, const PolygonParts& cut, const VoxelBox& box,
             const std::vector<PolygonMoments>& moments)
      : cut_(cut), box_(box), moments_(moments) {
    if (closed) return;
    in_whole_.resize(Window::count(box));
    mark_inside(cut.whole, box, in_whole_);
  }

  Volume make(const std::vector<uint32_t>& cells, MassUnits mass) const {
    PolygonBounds bounds;
    PolygonMoments sum;
    for (const uint32_t i : cells) {
      bounds.add(bounds_of(cut_.parts[i]));
      sum.volume += moments_[i].volume;
      sum.first += moments_[i].first;
    }
    const VoxelBox box = voxels_around(bounds, window_margin, box_);
    PolygonDistances distances(box);
    std::vector<uint8_t> inside(Window::count(box));
    for (const uint32_t i : cells) {
      const PolygonMesh& part = cut_.parts[i];
      // Between cells of one piece there is no surface.
      for (const PolygonFace& face : part.faces)
        if (!std::ranges::binary_search(cells, face.neighbour)) distances.add(part, face);
      if (in_whole_.empty()) {
        mark_inside(part, box, inside);
      } else if (!part.empty()) {
        mark_inside_cell(cut_.cells[i], box, inside);
      }
    }
    return {distances.codes(inside), mass, glm::vec3(sum.first / sum.volume)};
  }

 private:
  /// Marks the voxels that lie in the whole and below all planes of the cell.
  void mark_inside_cell(const PolygonMesh& cell, const VoxelBox& box, std::vector<uint8_t>& inside) const {
    const VoxelCoord size = box_.size();
    size_t i = 0;
    for (int x = box.lo.x; x < box.hi.x; ++x)
      for (int y = box.lo.y; y < box.hi.y; ++y)
        for (int z = box.lo.z; z < box.hi.z; ++z, ++i) {
          const auto at =
              static_cast<size_t>(((x - box_.lo.x) * size.y + (y - box_.lo.y)) * size.z + (z - box_.lo.z));
          if (in_whole_[at] == 0 || inside[i] != 0) continue;
          const bool beyond = std::ranges::any_of(cell.faces, [&](const PolygonFace& face) {
            return face.plane.distance(glm::dvec3(x, y, z)) > 0.0;
          });
          if (!beyond) inside[i] = 1;
        }
  }

  const PolygonParts& cut_;
  const VoxelBox& box_;
  const std::vector<PolygonMoments>& moments_;
  std::vector<uint8_t> in_whole_;  ///< where parts are not closed exactly
};

/// Faces between a voxel inside and one outside.
size_t faces_of(const Window& volume) {
  const VoxelCoord size = volume.box.size();
  const auto step_y = static_cast<size_t>(size.z), step_x = step_y * static_cast<size_t>(size.y);
  const auto differ = [&](size_t a, size_t b) {
    return (volume.codes[a] < 0) != (volume.codes[b] < 0) ? size_t{1} : size_t{0};
  };
  size_t faces = 0, i = 0;
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y)
      for (int z = 0; z < size.z; ++z, ++i) {
        if (z > 0) faces += differ(i, i - 1);
        if (y > 0) faces += differ(i, i - step_y);
        if (x > 0) faces += differ(i, i - step_x);
      }
  return faces;
}

}  // namespace

PolygonParts cut_polygons(const PolygonCutting& cutting, const Window& volume,
                          const std::vector<glm::vec3>& seeds_voxels) {
  PolygonParts cut;
  cut.whole = polygonise(volume);
  if (cut.whole.empty()) {
    cut.cells.resize(seeds_voxels.size());
    cut.parts.resize(seeds_voxels.size());
    return cut;
  }
  PolygonBounds room = bounds_of(cut.whole);
  room.lo -= cells_margin;
  room.hi += cells_margin;
  cut.cells = voronoi_cells(seeds_voxels, room);
  cut.parts = cutting.parts(cut.whole, cut.cells);
  return cut;
}

Cut cut_as_polygons(const PolygonCutting& cutting, const Window& volume, std::vector<uint8_t> lost,
                    const std::vector<glm::vec3>& seeds_voxels) {
  if (faces_of(volume) > polygon_faces_max) return cut_by_field(volume, std::move(lost), seeds_voxels);
  Cut cut;
  const MassUnits total = std::accumulate(lost.begin(), lost.end(), MassUnits{0});
  cut.dust = total;
  if (seeds_voxels.empty() || total < limits::piece_mass_min) return cut;
  const PolygonParts polygons = cut_polygons(cutting, volume, seeds_voxels);
  std::vector<PolygonMoments> moments;
  for (const PolygonMesh& part : polygons.parts) moments.push_back(moments_of(part));
  const std::vector<MassUnits> masses = masses_by_volume(total, moments);
  if (masses.empty()) return cut;

  const CellGroups groups(masses, touching_parts(polygons.parts));
  std::vector<std::vector<uint32_t>> cells(seeds_voxels.size());
  std::vector<MassUnits> mass(seeds_voxels.size());
  for (size_t i = 0; i < seeds_voxels.size(); ++i) {
    const CellLabel root = groups.root(static_cast<CellLabel>(i));
    cells[root].push_back(static_cast<uint32_t>(i));
    mass[root] += masses[i];
  }
  const PieceMaker maker(cutting.closed, polygons, volume.box, moments);
  for (size_t root = 0; root < cells.size(); ++root)
    if (!cells[root].empty()) {
      Volume piece = maker.make(cells[root], mass[root]);
      cut.pieces.push_back({std::move(piece), std::move(cells[root])});
    }
  cut.dust = 0;
  CHECK_EQ(std::accumulate(mass.begin(), mass.end(), MassUnits{0}), total);
  return cut;
}

}  // namespace scree
