#include "shared/surface/cube_cases.h"

#include <algorithm>
#include <span>
#include <vector>

#include "shared/base/check.h"
#include "shared/surface/leaf_loops.h"
#include "shared/surface/surface_cells.h"

namespace scree {
namespace {

using Cycle = std::vector<uint8_t>;

uint8_t number_of(const LeafEdge& edge) {
  const auto& edges = cell_tables().edges;
  const int from = edge.from.x << 2 | edge.from.y << 1 | edge.from.z;
  const int to = from | 4 >> edge.axis;
  const auto* found =
      std::ranges::find_if(edges, [&](const CellEdge& e) { return e.from == from && e.to == to; });
  CHECK(found != edges.end());
  return static_cast<uint8_t>(found - edges.begin());
}

/// Whether no face of the cell has both edges.
bool is_inner(uint8_t a, uint8_t b) {
  const CellEdge& one = cell_tables().edges[a];
  const CellEdge& other = cell_tables().edges[b];
  return ((one.from ^ one.to) | (other.from ^ other.to) | (one.from ^ other.from)) == cell_corners - 1;
}

/// Adds triangles that fill the polygon without a diagonal in a face; false if that is impossible.
bool fill(std::span<const uint8_t> polygon, Cycle& triangles) {
  if (polygon.size() < 3) return true;
  const size_t last = polygon.size() - 1, begun = triangles.size();
  for (size_t i = 1; i < last; ++i) {
    const bool fits = (i == 1 || is_inner(polygon[0], polygon[i])) &&
                      (i == last - 1 || is_inner(polygon[i], polygon[last]));
    if (!fits) continue;
    triangles.insert(triangles.end(), {polygon[0], polygon[i], polygon[last]});
    if (fill(polygon.first(i + 1), triangles) && fill(polygon.subspan(i), triangles)) return true;
    triangles.resize(begun);
  }
  return false;
}

CubeCase make_case(int signs) {
  LeafGrid cell({{0, 0, 0}, {1, 1, 1}});
  cell.sides.front() = 1;
  for (int i = 0; i < cell_corners; ++i)
    cell.distance_at({i >> 2, (i >> 1) & 1, i & 1}) = ((signs >> i) & 1) != 0 ? -1.0F : 1.0F;
  Cycle triangles;
  for (const std::vector<LeafEdge>& loop : cycles_of(cell, {{0, 0, 0}, 1})) {
    Cycle cycle;
    for (const LeafEdge& edge : loop) cycle.push_back(number_of(edge));
    CHECK(fill(cycle, triangles));
  }
  CubeCase made;
  CHECK(triangles.size() <= made.edges.size());
  made.triangles = static_cast<uint8_t>(triangles.size() / 3);
  std::ranges::copy(triangles, made.edges.begin());
  return made;
}

std::array<CubeCase, 256> make_cases() {
  std::array<CubeCase, 256> cases;
  for (int signs = 0; signs < 256; ++signs) cases[static_cast<size_t>(signs)] = make_case(signs);
  return cases;
}

}  // namespace

const std::array<CubeCase, 256>& cube_cases() {
  static const std::array<CubeCase, 256> cases = make_cases();
  return cases;
}

}  // namespace scree
