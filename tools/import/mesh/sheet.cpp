#include "tools/import/mesh/sheet.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace scree {

namespace {

/// Share of the surface that is missing from which a part is a sheet. A box without a side lacks 0.17, a dome
/// without a floor 0.33, a plane 0.5, and slopes of 45° everywhere 0.41.
constexpr double missing_least = 0.35;

/// Share of a field of heights that may hang over.
constexpr double overhang_most = 0.01;

/// Difference of two ways to close a part, relative, up to which nothing depends on the way.
constexpr double same_volume = 0.01;

struct Heights {
  double up_m2 = 0.0;     ///< seen from above, of what faces up
  double down_m2 = 0.0;   ///< and down
  double below_m3 = 0.0;  ///< between the part and its lowest point
};

Heights heights_of(const TriangleMesh& mesh, const MeshPart& part) {
  Heights heights;
  const double low = lowest_m(mesh, part);
  for (const uint32_t i : part.triangles) {
    const double seen = 0.5 * normal_of(mesh, i).y;
    (seen > 0.0 ? heights.up_m2 : heights.down_m2) += std::abs(seen);
    const TriangleMesh::Triangle& t = mesh.triangles[i];
    heights.below_m3 +=
        seen * ((mesh.points[t[0]].y + mesh.points[t[1]].y + mesh.points[t[2]].y) / 3.0 - low);
  }
  if (heights.down_m2 > heights.up_m2) {
    std::swap(heights.up_m2, heights.down_m2);
    heights.below_m3 = -heights.below_m3;
  }
  return heights;
}

}  // namespace

double lowest_m(const TriangleMesh& mesh, const MeshPart& part) {
  double low = 1e300;
  for (const uint32_t i : part.triangles)
    for (const uint32_t corner : mesh.triangles[i]) low = std::min(low, mesh.points[corner].y);
  return low;
}

bool is_sheet(const TriangleMesh& mesh, const MeshPart& part, double voxel_m) {
  if (part.open.empty()) return false;
  const Heights heights = heights_of(mesh, part);
  const bool is_field =
      heights.down_m2 <= overhang_most * heights.up_m2 && heights.up_m2 > 0.1 * part.area_m2;
  if (!is_field) return part.missing() >= missing_least;
  const double capped_m3 = std::abs(part.volume_m3);
  const bool has_body = capped_m3 > 0.5 * voxel_m * heights.up_m2;
  return !has_body || std::abs(heights.below_m3 - capped_m3) > same_volume * capped_m3;
}

TriangleMesh filled_down(const TriangleMesh& mesh, const MeshPart& part, double bottom_m) {
  TriangleMesh filled = part_mesh(mesh, part.triangles);
  if (part.facing_m2.y < 0.0)
    for (TriangleMesh::Triangle& t : filled.triangles) std::swap(t[1], t[2]);
  const auto uses = edge_uses(filled);
  const auto count = static_cast<uint32_t>(filled.points.size());
  const size_t sheet = filled.triangles.size();
  for (uint32_t i = 0; i < count; ++i) {
    glm::dvec3 foot = filled.points[i];
    foot.y = std::min(foot.y, bottom_m);
    filled.points.push_back(foot);
  }
  const auto add = [&](const TriangleMesh::Triangle& t, uint8_t material) {
    filled.add(t, material);
    if (!(glm::length(normal_of(filled, filled.triangles.size() - 1)) > 0.0)) {
      filled.triangles.pop_back();
      filled.materials.pop_back();
    }
  };
  for (size_t i = 0; i < sheet; ++i) {
    const TriangleMesh::Triangle t = filled.triangles[i];
    add({t[0] + count, t[2] + count, t[1] + count}, filled.materials[i]);
  }
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    const int balance = balance_of(edge);
    const auto [from, to] = balance > 0 ? std::pair(edge[0].a, edge[0].b) : std::pair(edge[0].b, edge[0].a);
    for (int i = 0; i < std::abs(balance); ++i) {
      add({to, from, from + count}, filled.materials[edge[0].triangle]);
      add({to, from + count, to + count}, filled.materials[edge[0].triangle]);
    }
  });
  return filled;
}

}  // namespace scree
