#include "tools/import/mesh/two_sides.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <tuple>

#include "tools/import/mesh/mesh_edges.h"

namespace scree {

namespace {

using Triangle = TriangleMesh::Triangle;

/// Volume between two sides up to which they are one surface, relative to their area.
constexpr double flat_share = 1.0e-6;

struct Sides {
  std::vector<bool> has_twin;   ///< of each triangle: its other side is there
  std::vector<bool> is_second;  ///< the later one of the two
  bool any = false;

  explicit Sides(size_t count) : has_twin(count, false), is_second(count, false) {}
  void pair(uint32_t first, uint32_t second) {
    has_twin[first] = has_twin[second] = any = true;
    is_second[std::max(first, second)] = true;
  }
};

/// The root of a point's connected part.
std::vector<uint32_t> roots_of(const TriangleMesh& mesh) {
  std::vector<uint32_t> root(mesh.points.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](uint32_t at) {
    while (root[at] != at) at = root[at] = root[root[at]];
    return at;
  };
  for (const Triangle& t : mesh.triangles)
    for (size_t k = 1; k < 3; ++k) root[find(t[k])] = find(t[0]);
  for (uint32_t i = 0; i < root.size(); ++i) root[i] = find(i);
  return root;
}

/// Triangles with the same corners in opposite orders.
void pair_triangles(const TriangleMesh& mesh, Sides& sides) {
  std::vector<Corners> all;
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    all.push_back(corners_of(mesh.triangles[i], static_cast<uint32_t>(i)));
  std::ranges::sort(all, [](const Corners& a, const Corners& b) {
    return std::tie(a.sorted, a.odd) < std::tie(b.sorted, b.odd);
  });
  for (size_t i = 1; i < all.size(); ++i)
    if (all[i].sorted == all[i - 1].sorted) sides.pair(all[i - 1].index, all[i].index);
}

/// Flat patches with the same border: the two sides of a polygon that was cut into triangles in two ways.
class PolygonSides {
 public:
  PolygonSides(const TriangleMesh& mesh, Sides& sides) : mesh_(mesh), sides_(sides) {}

  void run() {
    const auto uses = edge_uses(mesh_);
    bool shared = false;
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) { shared = shared || edge.size() > 3; });
    if (!shared) return;
    root_.resize(mesh_.triangles.size());
    std::iota(root_.begin(), root_.end(), 0U);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 2) root_[find(edge[1].triangle)] = find(edge[0].triangle);
    });
    std::map<uint32_t, Patch> patches;
    for (uint32_t i = 0; i < root_.size(); ++i) patches[find(i)].triangles.push_back(i);
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() == 2) return;
      for (const EdgeUse& use : edge) patches[find(use.triangle)].border.emplace_back(use.a, use.b);
    });
    std::map<std::vector<std::pair<uint32_t, uint32_t>>, std::vector<const Patch*>> by_border;
    for (const auto& [root, patch] : patches)
      if (!patch.border.empty() && !sides_.has_twin[root]) by_border[patch.border].push_back(&patch);
    for (const auto& [border, both] : by_border)
      if (both.size() == 2 && is_one_surface(*both[0], *both[1])) pair(*both[0], *both[1]);
  }

 private:
  struct Patch {
    std::vector<uint32_t> triangles;
    std::vector<std::pair<uint32_t, uint32_t>> border;  ///< sorted
  };

  uint32_t find(uint32_t at) {
    while (root_[at] != at) at = root_[at] = root_[root_[at]];
    return at;
  }
  bool is_one_surface(const Patch& one, const Patch& other) const {
    const glm::dvec3 origin = mesh_.points[mesh_.triangles[one.triangles.front()][0]];
    double volume = 0.0, area = 0.0;
    glm::dvec3 facing(0.0);
    for (const Patch* patch : {&one, &other})
      for (const uint32_t i : patch->triangles) {
        const Triangle& t = mesh_.triangles[i];
        const glm::dvec3 normal = normal_of(mesh_, i);
        volume += glm::dot(mesh_.points[t[0]] - origin, normal) / 6.0;
        area += 0.5 * glm::length(normal);
        facing += 0.5 * normal;
      }
    return glm::length(facing) <= flat_share * area &&
           std::abs(volume) <= flat_share * area * std::sqrt(area);
  }
  void pair(const Patch& one, const Patch& other) {
    for (const Patch* patch : {&one, &other})
      for (const uint32_t i : patch->triangles) sides_.has_twin[i] = true;
    const Patch& second = one.triangles.front() < other.triangles.front() ? other : one;
    for (const uint32_t i : second.triangles) sides_.is_second[i] = true;
    sides_.any = true;
  }

  const TriangleMesh& mesh_;
  Sides& sides_;
  std::vector<uint32_t> root_;
};

}  // namespace

Corners corners_of(Triangle t, uint32_t index) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  const bool odd = t[1] > t[2];
  if (odd) std::swap(t[1], t[2]);
  return {t, odd, index};
}

size_t resolve_two_sides(TriangleMesh& mesh) {
  Sides sides(mesh.triangles.size());
  pair_triangles(mesh, sides);
  PolygonSides(mesh, sides).run();
  if (!sides.any) return 0;
  const std::vector<uint32_t> root = roots_of(mesh);
  std::vector<bool> whole(mesh.points.size(), true);  // by root: all of the part has two sides
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    if (!sides.has_twin[i]) whole[root[mesh.triangles[i][0]]] = false;
  std::vector<bool> stays(mesh.triangles.size(), true);
  size_t left_out = 0;
  for (size_t i = 0; i < stays.size(); ++i) {
    const bool part_has_two = whole[root[mesh.triangles[i][0]]];
    stays[i] = !sides.has_twin[i] || (part_has_two && !sides.is_second[i]);
    if (!stays[i] && part_has_two) ++left_out;
  }
  retain_triangles(mesh, stays);
  return left_out;
}

}  // namespace scree
