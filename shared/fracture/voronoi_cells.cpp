#include "shared/fracture/voronoi_cells.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>

#include "shared/base/check.h"
#include "shared/base/random.h"

namespace scree {

namespace {

/// Squared distance to a seed, and its index: ordered, ties by index.
using Distant = std::pair<double, uint32_t>;

double farthest_corner2(const PolygonMesh& cell, glm::dvec3 from) {
  double farthest = 0.0;
  for (const glm::dvec3& corner : cell.vertices) {
    const glm::dvec3 off = corner - from;
    farthest = std::max(farthest, glm::dot(off, off));
  }
  return farthest;
}

/// Distance by which each seed is moved at most along each axis, voxels: far below the resolution of codes,
/// but no plane between two seeds then lies in a face of the surface, as planes between authored seeds easily
/// would.
constexpr float jitter_voxels = 1.0F / 1024.0F;

std::vector<glm::dvec3> jittered(const std::vector<glm::vec3>& seeds) {
  std::vector<glm::dvec3> moved;
  for (size_t i = 0; i < seeds.size(); ++i) {
    Random random(i);
    const auto by = [&] { return static_cast<double>((random.unit() - 0.5F) * 2.0F * jitter_voxels); };
    const double x = by(), y = by(), z = by();
    moved.push_back(glm::dvec3(seeds[i]) + glm::dvec3(x, y, z));
  }
  return moved;
}

/// For each seed whether it coincides with an earlier one.
std::vector<bool> duplicates(const std::vector<glm::vec3>& seeds) {
  std::vector<bool> found(seeds.size());
  std::vector<uint32_t> order(seeds.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](uint32_t i) { return std::tuple(seeds[i].x, seeds[i].y, seeds[i].z); };
  std::ranges::sort(order,
                    [&](uint32_t a, uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  for (size_t i = 1; i < order.size(); ++i) found[order[i]] = key(order[i]) == key(order[i - 1]);
  return found;
}

Plane bisector(glm::dvec3 own, glm::dvec3 other, double distance2) {
  CHECK_DEBUG(distance2 > 0.0);
  const glm::dvec3 normal = (other - own) / std::sqrt(distance2);
  return {normal, glm::dot(normal, (own + other) * 0.5)};
}

}  // namespace

std::vector<PolygonMesh> voronoi_cells(const std::vector<glm::vec3>& seeds, const PolygonBounds& bounds) {
  std::vector<PolygonMesh> cells(seeds.size());
  const std::vector<glm::dvec3> moved = jittered(seeds);
  const std::vector<bool> coincides = duplicates(seeds);
  Slicer slicer;
  std::vector<Distant> others;
  for (size_t i = 0; i < seeds.size(); ++i) {
    if (coincides[i]) continue;
    const glm::dvec3 own = moved[i];
    others.clear();
    for (size_t j = 0; j < seeds.size(); ++j) {
      if (j == i || coincides[j]) continue;
      const glm::dvec3 off = moved[j] - own;
      others.emplace_back(glm::dot(off, off), static_cast<uint32_t>(j));
    }
    // A heap: most seeds are never looked at.
    std::ranges::make_heap(others, std::greater<>());
    PolygonMesh& cell = cells[i];
    cell = box_mesh(bounds);
    while (!others.empty() && !cell.empty()) {
      const auto [distance2, j] = others.front();
      if (distance2 > 4.0 * farthest_corner2(cell, own)) break;
      std::ranges::pop_heap(others, std::greater<>());
      others.pop_back();
      slicer.slice(cell, bisector(own, moved[j], distance2), j);
    }
  }
  return cells;
}

}  // namespace scree
