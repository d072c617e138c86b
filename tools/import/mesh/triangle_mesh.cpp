#include "tools/import/mesh/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "tools/import/mesh/mesh_edges.h"
#include "tools/import/mesh/two_sides.h"

namespace scree {

namespace {

using Triangle = TriangleMesh::Triangle;

std::tuple<double, double, double> sorted_by(const glm::dvec3& p) {
  return {p.x, p.y, p.z};
}

/// For each point, the one that stands for it: the first at its place.
std::vector<uint32_t> same_places(const std::vector<glm::dvec3>& points) {
  std::vector<uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, [&](uint32_t a, uint32_t b) {
    return std::tuple(sorted_by(points[a]), a) < std::tuple(sorted_by(points[b]), b);
  });
  std::vector<uint32_t> stands(points.size());
  for (size_t i = 0; i < order.size(); ++i)
    stands[order[i]] = i > 0 && points[order[i]] == points[order[i - 1]] ? stands[order[i - 1]] : order[i];
  return stands;
}

/// Joins points of the border that are as near as that; returns how many.
class BorderJoin {
 public:
  BorderJoin(const TriangleMesh& mesh, double rounding_m) : mesh_(mesh), rounding_m_(rounding_m) {}

  size_t run(std::vector<uint32_t>& stands) {
    std::vector<uint32_t> border;
    for (const EdgeUse& use : border_edges(edge_uses(mesh_))) {
      border.push_back(use.a);
      border.push_back(use.b);
    }
    std::ranges::sort(border);
    border.erase(std::unique(border.begin(), border.end()), border.end());
    size_t joined = 0;
    for (const uint32_t point : border)
      if (const uint32_t other = near(point); other != point) {
        stands[point] = other;
        ++joined;
      }
    return joined;
  }

 private:
  using Cell = std::array<int64_t, 3>;
  struct CellHash {
    size_t operator()(const Cell& cell) const {
      uint64_t hash = 0;
      for (const int64_t at : cell) hash = (hash ^ static_cast<uint64_t>(at)) * 0x9E3779B97F4A7C15U;
      return hash ^ (hash >> 32U);
    }
  };

  /// The first point within reach, which may be itself; then it is one for others.
  uint32_t near(uint32_t point) {
    const glm::dvec3& p = mesh_.points[point];
    const Cell own = cell_of(p);
    for (int64_t i = 0; i < 27; ++i) {
      const auto found = cells_.find({own[0] + i / 9 - 1, own[1] + i / 3 % 3 - 1, own[2] + i % 3 - 1});
      if (found == cells_.end()) continue;
      for (const uint32_t other : found->second)
        if (glm::length(mesh_.points[other] - p) <= rounding_m_) return other;
    }
    cells_[own].push_back(point);
    return point;
  }
  Cell cell_of(const glm::dvec3& p) const {
    const auto axis = [&](double at) { return static_cast<int64_t>(std::floor(at / rounding_m_)); };
    return {axis(p.x), axis(p.y), axis(p.z)};
  }

  const TriangleMesh& mesh_;
  double rounding_m_;
  std::unordered_map<Cell, std::vector<uint32_t>, CellHash> cells_;
};

/// Puts the standing points into the triangles; those without an area, and doubles, go.
void replace_points(TriangleMesh& mesh, const std::vector<uint32_t>& stands) {
  std::vector<Corners> all;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    Triangle& t = mesh.triangles[i];
    for (uint32_t& corner : t) corner = stands[corner];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    all.push_back(corners_of(t, static_cast<uint32_t>(i)));
  }
  std::ranges::sort(all, [](const Corners& a, const Corners& b) {
    return std::tie(a.sorted, a.odd, a.index) < std::tie(b.sorted, b.odd, b.index);
  });
  std::vector<bool> stays(mesh.triangles.size(), false);
  for (size_t i = 0; i < all.size(); ++i)
    stays[all[i].index] = i == 0 || all[i].sorted != all[i - 1].sorted || all[i].odd != all[i - 1].odd;
  retain_triangles(mesh, stays);
}

/// Points that no triangle has go.
void drop_unused_points(TriangleMesh& mesh) {
  constexpr uint32_t none = ~0U;
  std::vector<uint32_t> place(mesh.points.size(), none);
  std::vector<glm::dvec3> points;
  for (Triangle& t : mesh.triangles)
    for (uint32_t& corner : t) {
      if (place[corner] == none) {
        place[corner] = static_cast<uint32_t>(points.size());
        points.push_back(mesh.points[corner]);
      }
      corner = place[corner];
    }
  mesh.points = std::move(points);
}

}  // namespace

WeldFindings weld(TriangleMesh& mesh, double rounding_m) {
  WeldFindings found;
  replace_points(mesh, same_places(mesh.points));
  if (rounding_m > 0.0) {
    std::vector<uint32_t> stands(mesh.points.size());
    std::iota(stands.begin(), stands.end(), 0U);
    found.joined_points = BorderJoin(mesh, rounding_m).run(stands);
    if (found.joined_points > 0) replace_points(mesh, stands);
  }
  found.two_sided_triangles = resolve_two_sides(mesh);
  drop_unused_points(mesh);
  return found;
}

glm::dvec3 normal_of(const TriangleMesh& mesh, size_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return glm::cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
}

double volume_m3(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return 0.0;
  double sum = 0.0;
  const glm::dvec3 origin = mesh.points[mesh.triangles.front()[0]];  // near, or digits are lost
  for (const Triangle& t : mesh.triangles)
    sum += glm::dot(mesh.points[t[0]] - origin,
                    glm::cross(mesh.points[t[1]] - origin, mesh.points[t[2]] - origin));
  return sum / 6.0;
}

}  // namespace scree
