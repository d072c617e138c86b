#include "shared/field/leaf_surface.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>

#include "shared/base/check.h"
#include "shared/field/leaf_loops.h"

namespace scree {
namespace {

/// Vertices keep that far from their leaf's faces: two leaves' vertices never coincide.
constexpr float inset = 1.0F / 256.0F;

glm::vec3 as_vector(VoxelCoord v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
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
    const bool first = grid.codes.at(leaf.at.x, leaf.at.y, leaf.at.z) < 0;
    for (int i = 1; i < 8; ++i)
      if ((grid.codes.at(leaf.at.x + (i >> 2) * leaf.side, leaf.at.y + ((i >> 1) & 1) * leaf.side,
                         leaf.at.z + (i & 1) * leaf.side) < 0) != first)
        return true;
    return false;
  }

  const Known& known(const Leaf& leaf) {
    static const Known nothing{};
    // A leaf of the smallest side has no points but its corners.
    if (leaf.side == 1 && !is_mixed(grid_, leaf)) return nothing;
    const auto [found, is_new] = known_.try_emplace(leaf.at);
    if (is_new) {
      Known& added = found->second;
      added.loops = trace_loops(grid_, leaf);
      std::vector<LeafCrossing> crossings;
      for (int sheet = 0; sheet < added.loops.sheets; ++sheet) {
        crossings.clear();
        for (const LeafEdge& edge : added.loops.crossed)
          if (added.loops.sheet(leaf, edge) == sheet)
            crossings.push_back({crossing_of(grid_, edge), edge.axis});
        const glm::vec3 low = as_vector(leaf.at);
        const glm::vec3 at = glm::clamp(rules_.place(leaf, crossings), low + inset,
                                        low + static_cast<float>(leaf.side) - inset);
        added.vertices.push_back(add_point(leaf, at));
      }
    }
    return found->second;
  }

  uint32_t add_point(const Leaf& leaf, glm::vec3 at) {
    mesh_.points.push_back({leaf, at});
    return static_cast<uint32_t>(mesh_.points.size() - 1);
  }

  /// Nothing when something beside the edge is unknown.
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
    if (grid_.codes.at(edge.from.x, edge.from.y, edge.from.z) >= 0) std::ranges::reverse(polygon_);
    add_polygon(edge, found.leaves[0], plain);
  }

  uint32_t vertex_at(const Leaf& leaf, const LeafEdge& edge) {
    const Known& there = known(leaf);
    return there.vertices[static_cast<size_t>(there.loops.sheet(leaf, edge))];
  }

  /// The vertex on the face between the leaves that keeps this edge's link apart from another between the
  /// same two sheets; if there is such another.
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
    if (is_new)
      found->second = add_point(small, (crossing_of(grid_, mine->a) + crossing_of(grid_, mine->b)) * 0.5F);
    return found->second;
  }

  /// A fan around the crossing shares no diagonal with anyone; a plain quad's diagonal is nobody else's
  /// either.
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
    const uint32_t middle = add_point(leaf, crossing_of(grid_, edge));
    for (size_t i = 0; i < count; ++i) add_triangle(middle, polygon_[i], polygon_[(i + 1) % count]);
  }

  float squared_length(size_t a, size_t b) const {
    const glm::vec3 d = mesh_.points[polygon_[a]].at - mesh_.points[polygon_[b]].at;
    return glm::dot(d, d);
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

LeafGrid::LeafGrid(const VoxelBox& box, Window window)
    : cells(box), sides(Window::count(box), leaf_unknown), codes(std::move(window)) {
  const VoxelBox& have = codes.box;
  CHECK(have.lo.x <= box.lo.x && have.lo.y <= box.lo.y && have.lo.z <= box.lo.z);
  CHECK(have.hi.x > box.hi.x && have.hi.y > box.hi.y && have.hi.z > box.hi.z);
}

size_t LeafGrid::index(VoxelCoord cell) const {
  const VoxelCoord size = cells.size(), off = cell - cells.lo;
  return (static_cast<size_t>(off.x) * static_cast<size_t>(size.y) + static_cast<size_t>(off.y)) *
             static_cast<size_t>(size.z) +
         static_cast<size_t>(off.z);
}

Leaf LeafGrid::leaf_at(VoxelCoord cell) const {
  const int side = side_at(cell);
  return {{cell.x & -side, cell.y & -side, cell.z & -side}, side};
}

LeafMesh leaf_surface(const LeafGrid& grid, std::span<const Leaf> leaves, const LeafRules& rules) {
  return Mesher(grid, rules).build(leaves);
}

glm::vec3 mean_of(std::span<const LeafCrossing> crossings) {
  glm::vec3 sum(0.0F);
  for (const LeafCrossing& crossing : crossings) sum += crossing.at;
  return sum / static_cast<float>(crossings.size());
}

}  // namespace scree
