#include "shared/surface/leaf_surface.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>

#include "shared/base/check.h"
#include "shared/surface/leaf_loops.h"
#include "shared/surface/placed_sheets.h"
#include "shared/surface/surface_mesh.h"

namespace scree {
namespace {

using Steps = std::array<int32_t, 3>;

Steps steps_of(VoxelCoord p) {
  return {p.x * surface_steps, p.y * surface_steps, p.z * surface_steps};
}

CellSteps steps_in(const Leaf& leaf, const Steps& steps) {
  const Steps low = steps_of(leaf.at);
  return {(steps[0] - low[0]) / leaf.side, (steps[1] - low[1]) / leaf.side, (steps[2] - low[2]) / leaf.side};
}

Steps steps_of(const LeafGrid& grid, const LeafEdge& edge) {
  Steps steps = steps_of(edge.from);
  // Off the ends, where other edges' crossings might be.
  const int length = edge.length * surface_steps;
  const auto along = static_cast<int>(crossing_of(grid, edge) * static_cast<float>(length) + 0.5F);
  steps[static_cast<size_t>(edge.axis)] += std::clamp(along, 1, length - 1);
  return steps;
}

/// The leaves around an edge, counter-clockwise seen from where it points to, and the axis of the face that
/// each shares with the next one.
struct Around {
  std::array<Leaf, 4> leaves;
  std::array<int, 4> axis_to_next{};
  size_t count = 0;

  std::span<const Leaf> span() const { return {leaves.data(), count}; }
};

class Mesher {
 public:
  Mesher(const LeafGrid& grid, const LeafRules& rules) : grid_(grid), rules_(rules) {}

  LeafMesh build(std::span<const Leaf> leaves) {
    for (const Leaf& leaf : leaves)
      for (const LeafEdge& edge : known(leaf).loops.crossed) add_edge(edge);
    return std::move(mesh_);
  }

 private:
  struct Known {
    LeafLoops loops;
    std::vector<uint32_t> vertices;  ///< of its sheets, once they are needed
  };

  static bool is_mixed(const LeafGrid& grid, const Leaf& leaf) {
    const auto rock = [&](int i) {
      return grid.distance_at(leaf.at + VoxelCoord{(i >> 2) * leaf.side, ((i >> 1) & 1) * leaf.side,
                                                   (i & 1) * leaf.side}) < 0.0F;
    };
    for (int i = 1; i < 8; ++i)
      if (rock(i) != rock(0)) return true;
    return false;
  }

  /// Whether the signs differ at the points where the leaf's boundary could be divided, whether it is or not.
  bool may_be_crossed(const Leaf& leaf) const {
    const int points = leaf.side == 1 ? 2 : 3, step = leaf.side == 1 ? 1 : leaf.side / 2;
    const bool rock = grid_.distance_at(leaf.at) < 0.0F;
    for (int x = 0; x < points; ++x)
      for (int y = 0; y < points; ++y)
        for (int z = 0; z < points; ++z)
          if ((grid_.distance_at(leaf.at + VoxelCoord{x * step, y * step, z * step}) < 0.0F) != rock)
            return true;
    return false;
  }

  const Known& known(const Leaf& leaf) {
    static const Known nothing{};
    const auto found = known_.find(leaf.at);
    if (found != known_.end()) return found->second;
    if (!may_be_crossed(leaf)) return nothing;
    const bool mixed = is_mixed(grid_, leaf);
    const bool undivided = is_undivided(grid_, leaf);
    if (undivided && !mixed) return nothing;
    Known& added = known_[leaf.at];
    added.loops = trace_loops(grid_, leaf, LeafRuns::rock);
    if (undivided && is_pinched(leaf, added.loops)) added.loops = trace_loops(grid_, leaf, LeafRuns::air);
    for (int sheet = 0; sheet < added.loops.sheets; ++sheet)
      added.vertices.push_back(add_vertex(leaf, added, sheet));
    return added;
  }

  /// Whether the leaf and its neighbour, of the same size and undivided like it, are pinched at one face.
  bool is_pinched(const Leaf& leaf, const LeafLoops& loops) const {
    const int face = pinched_face(grid_, leaf, loops);
    if (face < 0) return false;
    const int by = face % 2 == 1 ? leaf.side : -leaf.side;
    const VoxelCoord at =
        leaf.at + VoxelCoord{face / 2 == 0 ? by : 0, face / 2 == 1 ? by : 0, face / 2 == 2 ? by : 0};
    if (grid_.side_at(at) != leaf.side) return false;
    const Leaf other{at, leaf.side};
    return is_undivided(grid_, other) &&
           pinched_face(grid_, other, trace_loops(grid_, other, LeafRuns::rock)) == (face ^ 1);
  }

  uint32_t add_vertex(const Leaf& leaf, const Known& there, int sheet) {
    std::vector<LeafCrossing> crossings;
    const auto side = static_cast<float>(leaf.side);
    for (const LeafEdge& edge : there.loops.crossed) {
      if (there.loops.sheet(leaf, edge) != sheet) continue;
      const VoxelCoord off = edge.from - leaf.at;
      glm::vec3 at(static_cast<float>(off.x), static_cast<float>(off.y), static_cast<float>(off.z));
      at /= side;
      at[edge.axis] += crossing_of(grid_, edge) * (static_cast<float>(edge.length) / side);
      crossings.push_back({at, edge.axis});
    }
    // In steps of the leaf's own size.
    std::vector<CellSteps> before;
    for (const uint32_t other : there.vertices) before.push_back(steps_in(leaf, mesh_.points[other].steps));
    const CellSteps inside = steps_inside(rules_.place(leaf, crossings), before);
    Steps steps = steps_of(leaf.at);
    for (size_t i = 0; i < 3; ++i) steps[i] += inside[i] * leaf.side;
    return add_point(leaf, steps);
  }

  uint32_t add_point(const Leaf& leaf, const Steps& steps) {
    mesh_.points.push_back({leaf, steps});
    return static_cast<uint32_t>(mesh_.points.size() - 1);
  }

  /// The leaves around an edge; none if one of them is unknown.
  Around around(const LeafEdge& edge) const {
    const int u = (edge.axis + 1) % 3, v = (edge.axis + 2) % 3;
    constexpr std::array<std::array<int, 2>, 4> quadrants{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
    Around found;
    for (size_t i = 0; i < 4; ++i) {
      std::array<int, 3> cell{edge.from.x, edge.from.y, edge.from.z};
      cell[static_cast<size_t>(u)] += quadrants[i][0];
      cell[static_cast<size_t>(v)] += quadrants[i][1];
      const VoxelCoord at{cell[0], cell[1], cell[2]};
      if (grid_.side_at(at) == leaf_unknown) return {};
      const Leaf leaf = grid_.leaf_at(at);
      const int axis_to_next = i % 2 == 0 ? u : v;
      if (found.count > 0 && found.leaves[found.count - 1] == leaf) {
        found.axis_to_next[found.count - 1] = axis_to_next;
        continue;
      }
      found.leaves[found.count] = leaf;
      found.axis_to_next[found.count++] = axis_to_next;
    }
    if (found.count > 1 && found.leaves[0] == found.leaves[found.count - 1]) --found.count;
    return found;
  }

  void add_edge(const LeafEdge& edge) {
    if (!done_.insert(edge).second) return;
    const Around found = around(edge);
    if (found.count < 3 || !rules_.owns(found.span())) return;
    polygon_.clear();
    bool plain = found.count == 4;
    for (size_t i = 0; i < found.count; ++i) {
      const Leaf& leaf = found.leaves[i];
      const Leaf& next = found.leaves[(i + 1) % found.count];
      plain = plain && leaf.side == next.side;
      polygon_.push_back(vertex_at(leaf, edge));
      if (const auto apart = vertex_between(leaf, next, found.axis_to_next[i], edge)) {
        polygon_.push_back(*apart);
        plain = false;
      }
    }
    if (grid_.distance_at(edge.from) >= 0.0F) std::ranges::reverse(polygon_);
    add_polygon(edge, found.leaves[0], plain);
  }

  uint32_t vertex_at(const Leaf& leaf, const LeafEdge& edge) {
    const Known& there = known(leaf);
    CHECK_DEBUG(static_cast<size_t>(there.loops.sheet(leaf, edge)) < there.vertices.size());
    return there.vertices[static_cast<size_t>(there.loops.sheet(leaf, edge))];
  }

  /// The vertex on the face between the leaves that separates this edge's link from another link between the
  /// same two sheets, if there is one.
  std::optional<uint32_t> vertex_between(const Leaf& a, const Leaf& b, int axis, const LeafEdge& edge) {
    // Both polygons at the face must name it alike.
    const bool a_first = std::pair(a.side, a.at) < std::pair(b.side, b.at);
    const Leaf& small = a_first ? a : b;
    const Leaf& large = a_first ? b : a;
    const auto at = [axis](const Leaf& leaf) {
      return axis == 0 ? leaf.at.x : (axis == 1 ? leaf.at.y : leaf.at.z);
    };
    const bool upper = at(large) > at(small);
    const int face = 2 * axis + (upper ? 1 : 0);
    const std::vector<LeafLink> links = links_of_face(grid_, small, face);
    if (links.size() < 2) return std::nullopt;
    const auto sheets = [&](const LeafEdge& e) {
      return std::pair(known(small).loops.sheet(small, e), known(large).loops.sheet(large, e));
    };
    const auto mine =
        std::ranges::find_if(links, [&](const LeafLink& l) { return l.a == edge || l.b == edge; });
    CHECK(mine != links.end());
    const auto alike =
        std::ranges::count_if(links, [&](const LeafLink& l) { return sheets(l.a) == sheets(mine->a); });
    if (alike < 2) return std::nullopt;
    const auto [found, is_new] = apart_.try_emplace({small.at, face, mine->a});
    if (is_new) {
      const Steps one = steps_of(grid_, mine->a), other = steps_of(grid_, mine->b);
      found->second =
          add_point(small, {(one[0] + other[0]) / 2, (one[1] + other[1]) / 2, (one[2] + other[2]) / 2});
    }
    return found->second;
  }

  /// Neither a fan around the crossing nor a plain quad has a diagonal that another polygon has, too.
  void add_polygon(const LeafEdge& edge, const Leaf& leaf, bool plain) {
    const size_t count = polygon_.size();
    if (count == 3) return add_triangle(polygon_[0], polygon_[1], polygon_[2]);
    if (plain) {
      const size_t first = squared_length(0, 2) <= squared_length(1, 3) ? 0 : 1;
      const auto corner = [&](size_t i) { return polygon_[(first + i) % 4]; };
      add_triangle(corner(0), corner(1), corner(2));
      add_triangle(corner(0), corner(2), corner(3));
      return;
    }
    const uint32_t middle = add_point(leaf, steps_of(grid_, edge));
    for (size_t i = 0; i < count; ++i) add_triangle(middle, polygon_[i], polygon_[(i + 1) % count]);
  }

  int64_t squared_length(size_t a, size_t b) const {
    int64_t sum = 0;
    for (size_t i = 0; i < 3; ++i) {
      const int64_t d = mesh_.points[polygon_[a]].steps[i] - mesh_.points[polygon_[b]].steps[i];
      sum += d * d;
    }
    return sum;
  }

  void add_triangle(uint32_t a, uint32_t b, uint32_t c) {
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
  }

  const LeafGrid& grid_;
  const LeafRules& rules_;
  LeafMesh mesh_;
  std::unordered_map<VoxelCoord, Known, CoordHash> known_;
  std::set<LeafEdge> done_;
  std::map<std::tuple<VoxelCoord, int, LeafEdge>, uint32_t> apart_;
  std::vector<uint32_t> polygon_;
};

}  // namespace

LeafGrid::LeafGrid(const VoxelBox& box)
    : cells(box),
      sides(Window::count(box), leaf_unknown),
      distances(Window::count({box.lo, box.hi + VoxelCoord{1, 1, 1}})) {}

size_t LeafGrid::point_index(VoxelCoord p) const {
  CHECK_DEBUG((VoxelBox{cells.lo, cells.hi + VoxelCoord{1, 1, 1}}.holds(p)));
  const VoxelCoord size = cells.size(), off = p - cells.lo;
  return (static_cast<size_t>(off.x) * static_cast<size_t>(size.y + 1) + static_cast<size_t>(off.y)) *
             static_cast<size_t>(size.z + 1) +
         static_cast<size_t>(off.z);
}

size_t LeafGrid::index(VoxelCoord cell) const {
  CHECK_DEBUG(cells.holds(cell));
  const VoxelCoord size = cells.size(), off = cell - cells.lo;
  return (static_cast<size_t>(off.x) * static_cast<size_t>(size.y) + static_cast<size_t>(off.y)) *
             static_cast<size_t>(size.z) +
         static_cast<size_t>(off.z);
}

Leaf LeafGrid::leaf_at(VoxelCoord cell) const {
  const int side = side_at(cell);
  CHECK_DEBUG(side > 0 && (side & (side - 1)) == 0);
  return {{cell.x & -side, cell.y & -side, cell.z & -side}, side};
}

LeafMesh leaf_surface(const LeafGrid& grid, std::span<const Leaf> leaves, const LeafRules& rules) {
  return Mesher(grid, rules).build(leaves);
}

glm::vec3 mean_of(std::span<const LeafCrossing> crossings) {
  CHECK(!crossings.empty());
  glm::vec3 sum(0.0F);
  for (const LeafCrossing& crossing : crossings) sum += crossing.at;
  return sum / static_cast<float>(crossings.size());
}

}  // namespace scree
