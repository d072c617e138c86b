#include "shared/surface/leaf_loops.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "shared/base/check.h"
#include "shared/surface/surface_cells.h"

namespace scree {
namespace {

int& component(VoxelCoord& v, int axis) {
  return axis == 0 ? v.x : (axis == 1 ? v.y : v.z);
}

int component(const VoxelCoord& v, int axis) {
  return axis == 0 ? v.x : (axis == 1 ? v.y : v.z);
}

VoxelCoord moved(VoxelCoord v, int axis, int by) {
  component(v, axis) += by;
  return v;
}

bool is_rock(const LeafGrid& grid, VoxelCoord p) {
  return grid.distance_at(p) < 0.0F;
}

bool is_finer(const LeafGrid& grid, const Leaf& leaf, VoxelCoord cell) {
  const int side = grid.side_at(cell);
  return side != leaf_unknown && side < leaf.side;
}

/// A cell just beyond the face.
VoxelCoord beyond(const Leaf& leaf, int axis, bool upper) {
  return moved(leaf.at, axis, upper ? leaf.side : -1);
}

bool is_divided(const LeafGrid& grid, const Leaf& leaf, int axis, bool upper) {
  return leaf.side > 1 && is_finer(grid, leaf, beyond(leaf, axis, upper));
}

/// Whether the leaf's edge along the third axis, at those sides of the two others, is divided.
bool is_edge_divided(const LeafGrid& grid, const Leaf& leaf, int u, bool upper_u, int v, bool upper_v) {
  if (leaf.side == 1) return false;
  return is_divided(grid, leaf, u, upper_u) || is_divided(grid, leaf, v, upper_v) ||
         is_finer(grid, leaf, moved(beyond(leaf, u, upper_u), v, upper_v ? leaf.side : -1));
}

/// A polygon of a leaf's divided boundary, as a cycle of at most eight points.
struct Polygon {
  std::array<VoxelCoord, 8> points;
  size_t count = 0;

  void add(VoxelCoord p) {
    CHECK_DEBUG(count < points.size());
    points[count++] = p;
  }
};

Polygon square(VoxelCoord at, int u, int v, int side) {
  Polygon polygon;
  polygon.add(at);
  polygon.add(moved(at, u, side));
  polygon.add(moved(moved(at, u, side), v, side));
  polygon.add(moved(at, v, side));
  return polygon;
}

/// The undivided face, with the points in the middle of its divided edges.
Polygon whole_face(const LeafGrid& grid, const Leaf& leaf, int axis, bool upper) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Polygon corners = square(moved(leaf.at, axis, upper ? leaf.side : 0), u, v, leaf.side);
  // Edges 0 and 2 of the square lie at v's ends, 1 and 3 at u's.
  const std::array<int, 4> across{v, u, v, u};
  const std::array<bool, 4> at_upper{false, true, true, false};
  Polygon polygon;
  for (size_t i = 0; i < 4; ++i) {
    const VoxelCoord a = corners.points[i], b = corners.points[(i + 1) % 4];
    polygon.add(a);
    if (is_edge_divided(grid, leaf, axis, upper, across[i], at_upper[i]))
      polygon.add({(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2});
  }
  return polygon;
}

LeafEdge edge_between(VoxelCoord a, VoxelCoord b) {
  const VoxelCoord d = b - a;
  const int axis = d.x != 0 ? 0 : (d.y != 0 ? 1 : 2);
  const int length = component(d, axis);
  CHECK_DEBUG(length != 0 && std::abs(d.x) + std::abs(d.y) + std::abs(d.z) == std::abs(length));
  return length > 0 ? LeafEdge{a, axis, length} : LeafEdge{b, axis, -length};
}

/// Calls f(edge, edge) for each run along the cycle, with the crossed edges at its two ends.
template <typename F>
void for_each_link(const LeafGrid& grid, const Polygon& polygon, LeafRuns runs, F&& f) {
  std::array<bool, 8> rock{};
  for (size_t i = 0; i < polygon.count; ++i)
    rock[i] = is_rock(grid, polygon.points[i]) == (runs == LeafRuns::rock);
  const auto next = [&](size_t i) { return (i + 1) % polygon.count; };
  const auto edge = [&](size_t i) { return edge_between(polygon.points[i], polygon.points[next(i)]); };
  for (size_t i = 0; i < polygon.count; ++i) {
    if (rock[i] || !rock[next(i)]) continue;
    size_t end = next(i);
    while (rock[next(end)]) end = next(end);
    f(edge(i), edge(end));
  }
}

/// Calls f(polygon, upper): of an upper face they are counter-clockwise seen from outside, else clockwise.
template <typename F>
void for_each_polygon(const LeafGrid& grid, const Leaf& leaf, F&& f) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool upper : {false, true}) {
      if (!is_divided(grid, leaf, axis, upper)) {
        f(whole_face(grid, leaf, axis, upper), upper);
        continue;
      }
      const int half = leaf.side / 2;
      const VoxelCoord at = moved(leaf.at, axis, upper ? leaf.side : 0);
      for (int i = 0; i < 4; ++i)
        f(square(moved(moved(at, u, (i >> 1) * half), v, (i & 1) * half), u, v, half), upper);
    }
  }
}

}  // namespace

VoxelCoord LeafEdge::to() const {
  return moved(from, axis, length);
}

size_t id_in(const Leaf& leaf, const LeafEdge& edge) {
  const VoxelCoord off = edge.from - leaf.at;
  const auto on_lattice = [&](int v) { return v * 2 / leaf.side; };
  const int point = (on_lattice(off.x) * 3 + on_lattice(off.y)) * 3 + on_lattice(off.z);
  const auto id = static_cast<size_t>(point * 3 + edge.axis + (edge.length == leaf.side ? 81 : 0));
  CHECK_DEBUG(point >= 0 && point < 27 && id < leaf_edge_ids);
  return id;
}

bool is_crossed(const LeafGrid& grid, const LeafEdge& edge) {
  return is_rock(grid, edge.from) != is_rock(grid, edge.to());
}

float crossing_of(const LeafGrid& grid, const LeafEdge& edge) {
  CHECK_DEBUG(is_crossed(grid, edge));
  const float a = grid.distance_at(edge.from), b = grid.distance_at(edge.to());
  return a / (a - b);
}

bool is_undivided(const LeafGrid& grid, const Leaf& leaf) {
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true})
      for (const bool other : {false, true})
        if (is_edge_divided(grid, leaf, axis, upper, (axis + 1) % 3, other)) return false;
  for (int i = 0; i < 8 && leaf.side > 1; ++i) {
    const auto at = [&](int bit) { return (i & bit) != 0 ? leaf.side : -1; };
    if (is_finer(grid, leaf, leaf.at + VoxelCoord{at(4), at(2), at(1)})) return false;
  }
  return true;
}

int pinched_face(const LeafGrid& grid, const Leaf& leaf, const LeafLoops& loops) {
  for (int face = 0; face < 6; ++face) {
    const std::vector<LeafLink> links = links_of_face(grid, leaf, face);
    if (links.size() > 1 && loops.sheet(leaf, links[0].a) == loops.sheet(leaf, links[1].a)) return face;
  }
  return -1;
}

LeafLoops trace_loops(const LeafGrid& grid, const Leaf& leaf, LeafRuns runs) {
  LeafLoops loops;
  loops.sheet_of.fill(no_sheet);
  std::array<uint8_t, leaf_edge_ids> root;
  std::iota(root.begin(), root.end(), uint8_t{0});
  const auto find = [&root](size_t id) {
    while (root[id] != id) id = root[id];
    return id;
  };
  for_each_polygon(grid, leaf, [&](const Polygon& polygon, bool) {
    for_each_link(grid, polygon, runs, [&](const LeafEdge& a, const LeafEdge& b) {
      for (const LeafEdge& edge : {a, b}) {
        uint8_t& seen = loops.sheet_of[id_in(leaf, edge)];
        if (seen == no_sheet) loops.crossed.push_back(edge);
        seen = 0;
      }
      root[find(id_in(leaf, a))] = static_cast<uint8_t>(find(id_in(leaf, b)));
    });
  });
  // In the order in which surface_nets sums: the same bits.
  std::ranges::sort(loops.crossed, {}, [](const LeafEdge& e) { return std::pair(e.axis, e); });
  std::array<uint8_t, leaf_edge_ids> sheet_of_root;
  sheet_of_root.fill(no_sheet);
  for (const LeafEdge& edge : loops.crossed) {
    uint8_t& sheet = sheet_of_root[find(id_in(leaf, edge))];
    if (sheet == no_sheet) sheet = static_cast<uint8_t>(loops.sheets++);
    loops.sheet_of[id_in(leaf, edge)] = sheet;
  }
  return loops;
}

std::vector<std::vector<LeafEdge>> cycles_of(const LeafGrid& grid, const Leaf& leaf) {
  std::array<std::optional<LeafEdge>, leaf_edge_ids> next;
  std::vector<LeafEdge> crossed;
  for_each_polygon(grid, leaf, [&](const Polygon& polygon, bool upper) {
    for_each_link(grid, polygon, LeafRuns::rock, [&](const LeafEdge& a, const LeafEdge& b) {
      next[id_in(leaf, upper ? a : b)] = upper ? b : a;
      crossed.push_back(upper ? a : b);
    });
  });
  std::ranges::sort(crossed);
  std::vector<std::vector<LeafEdge>> cycles;
  for (LeafEdge edge : crossed) {
    std::vector<LeafEdge> cycle;
    while (const std::optional<LeafEdge> after = std::exchange(next[id_in(leaf, edge)], std::nullopt)) {
      cycle.push_back(edge);
      edge = *after;
    }
    CHECK(cycle.empty() || edge == cycle.front());  // every loop closes
    if (!cycle.empty()) cycles.push_back(std::move(cycle));
  }
  return cycles;
}

std::vector<LeafLink> links_of_face(const LeafGrid& grid, const Leaf& leaf, int face) {
  std::vector<LeafLink> links;
  for_each_link(grid, whole_face(grid, leaf, face / 2, face % 2 == 1), LeafRuns::rock,
                [&](const LeafEdge& a, const LeafEdge& b) {
                  links.push_back({a, b});
                });
  return links;
}

}  // namespace scree
