#include "tools/import/mesh/mesh_parts.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "tools/import/mesh/border_pairs.h"
#include "tools/import/mesh/part_nesting.h"

namespace scree {

namespace {

/// Sets of triangles, and in each the triangles that stand against its first.
class ParityUnion {
 public:
  explicit ParityUnion(size_t count) : root_(count), against_(count, false) {
    std::iota(root_.begin(), root_.end(), 0U);
  }
  /// Root, and whether the triangle stands against it.
  std::pair<uint32_t, bool> find(uint32_t at) {
    bool against = false;
    uint32_t top = at;
    while (root_[top] != top) {
      against = against != against_[top];
      top = root_[top];
    }
    for (bool left = against; root_[at] != at;) {  // shortens the way
      const uint32_t above = root_[at];
      const bool own = against_[at];
      root_[at] = top;
      against_[at] = left;
      left = left != own;
      at = above;
    }
    return {top, against};
  }
  /// The lower root stays. A link that contradicts earlier ones changes nothing.
  void link(uint32_t one, uint32_t other, bool against) {
    auto [a, a_against] = find(one);
    auto [b, b_against] = find(other);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    root_[b] = a;
    against_[b] = (a_against != b_against) != against;
  }

 private:
  std::vector<uint32_t> root_;
  std::vector<bool> against_;
};

/// Patches: triangles that their edges tie to each other, all turned alike.
class Patches {
 public:
  Patches(TriangleMesh& mesh, double tolerance_m) : mesh_(mesh), uses_(edge_uses(mesh)) {
    const std::vector<EdgeUse> border = border_edges(uses_);
    const BorderMatch match = match_borders(mesh, border, tolerance_m);
    ParityUnion all(mesh.triangles.size());
    link(all, match.pairs);
    for (size_t i = 0; i < border.size(); ++i)
      if (match.joined[i]) joined_.push_back({border[i].a, border[i].b});
    turn_minorities(all);
    join(all);
  }

  size_t turned() const { return turned_; }
  std::vector<MeshPart> parts() {
    std::map<uint32_t, size_t> numbers;
    std::vector<MeshPart> parts;
    for (uint32_t i = 0; i < root_.size(); ++i) {
      const auto [found, is_new] = numbers.try_emplace(root_[i], parts.size());
      if (is_new) parts.emplace_back();
      parts[found->second].triangles.push_back(i);
    }
    for_each_edge(uses_, [&](std::span<const EdgeUse> edge) {
      for_each_root(edge, [&](uint32_t root, const EdgeUse& first, int balance) {
        if (balance == 0 || is_joined(edge)) return;
        parts[numbers.at(root)].open.push_back({first.a, first.b, first.triangle, balance > 0});
      });
    });
    return parts;
  }

 private:
  bool is_joined(std::span<const EdgeUse> edge) const {
    return edge.size() == 1 && std::ranges::binary_search(joined_, std::pair(edge.front().a, edge.front().b));
  }

  /// Calls f(root, a use, balance) for each part at an edge. Any number of triangles may share one.
  template <typename F>
  void for_each_root(std::span<const EdgeUse> edge, F&& f) const {
    const auto root_of = [&](const EdgeUse& use) { return root_[use.triangle]; };
    const auto is_of_first = [&](const EdgeUse& use) { return root_of(use) == root_of(edge.front()); };
    if (std::ranges::all_of(edge, is_of_first))
      return f(root_of(edge.front()), edge.front(), balance_of(edge));
    std::vector<EdgeUse> uses(edge.begin(), edge.end());
    std::ranges::stable_sort(uses, {}, root_of);
    for (auto first = uses.begin(); first != uses.end();) {
      const auto end = std::ranges::find_if(
          first, uses.end(), [&](const EdgeUse& use) { return root_of(use) != root_of(*first); });
      f(root_of(*first), *first, balance_of({first, end}));
      first = end;
    }
  }

  /// Neighbours that agree come first: where links contradict each other, as around a few bad triangles or on
  /// a surface with one side, the file's own order stays, and no wide patch is turned for the sake of a seam.
  void link(ParityUnion& all, const std::vector<BorderPair>& pairs) const {
    for (const bool against : {false, true})
      for_each_edge(uses_, [&](std::span<const EdgeUse> edge) {
        if (edge.size() == 2 && (edge[0].forward == edge[1].forward) == against)
          all.link(edge[0].triangle, edge[1].triangle, against);
      });
    for (const bool against : {false, true})
      for (const BorderPair& pair : pairs)
        if (pair.agree != against) all.link(pair.one, pair.other, against);
  }

  void turn_minorities(ParityUnion& all) {
    std::vector<double> against_m2(mesh_.triangles.size()), with_m2(mesh_.triangles.size());
    for (uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const auto [root, against] = all.find(i);
      (against ? against_m2 : with_m2)[root] += glm::length(normal_of(mesh_, i));
    }
    std::vector<bool> turns(mesh_.triangles.size());
    for (uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const auto [root, against] = all.find(i);
      turns[i] = against == (against_m2[root] <= with_m2[root]);
      if (!turns[i]) continue;
      std::swap(mesh_.triangles[i][1], mesh_.triangles[i][2]);
      ++turned_;
    }
    for (EdgeUse& use : uses_)
      if (turns[use.triangle]) use.forward = !use.forward;
  }

  /// Patches that are closed are parts; others are parts with those that they share points with.
  void join(ParityUnion& all) {
    root_.resize(mesh_.triangles.size());
    for (uint32_t i = 0; i < root_.size(); ++i) root_[i] = all.find(i).first;
    std::vector<bool> has_hole(root_.size(), false);
    for_each_edge(uses_, [&](std::span<const EdgeUse> edge) {
      for_each_root(edge, [&](uint32_t root, const EdgeUse&, int balance) {
        if (balance != 0 && !is_joined(edge)) has_hole[root] = true;
      });
    });
    constexpr uint32_t none = ~0U;
    std::vector<uint32_t> holder(mesh_.points.size(), none);
    for (uint32_t i = 0; i < root_.size(); ++i) {
      if (!has_hole[root_[i]]) continue;
      for (const uint32_t corner : mesh_.triangles[i]) {
        if (holder[corner] == none) holder[corner] = i;
        all.link(i, holder[corner], false);
      }
    }
    for (uint32_t i = 0; i < root_.size(); ++i)
      if (has_hole[root_[i]]) root_[i] = all.find(i).first;
  }

  TriangleMesh& mesh_;
  std::vector<EdgeUse> uses_;
  std::vector<std::pair<uint32_t, uint32_t>> joined_;  ///< edges, sorted as the border is
  std::vector<uint32_t> root_;                         ///< of each triangle's part
  size_t turned_ = 0;
};

/// The loops of open edges, each with the middle of its points.
std::vector<std::pair<std::vector<EdgeUse>, glm::dvec3>> loops_of(const TriangleMesh& mesh,
                                                                  const std::vector<EdgeUse>& open) {
  std::map<uint32_t, uint32_t> root;
  const auto find = [&](uint32_t at) {
    uint32_t top = root.try_emplace(at, at).first->second;
    while (root[top] != top) top = root[top] = root[root[top]];
    return root[at] = top;
  };
  for (const EdgeUse& use : open) root[find(use.a)] = find(use.b);
  std::map<uint32_t, std::vector<EdgeUse>> by_root;
  for (const EdgeUse& use : open) by_root[find(use.a)].push_back(use);
  std::vector<std::pair<std::vector<EdgeUse>, glm::dvec3>> loops;
  for (auto& [top, edges] : by_root) {
    glm::dvec3 sum(0.0);
    double length = 0.0;
    for (const EdgeUse& use : edges) {
      const double own = glm::length(mesh.points[use.b] - mesh.points[use.a]);
      sum += 0.5 * own * (mesh.points[use.a] + mesh.points[use.b]);
      length += own;
    }
    loops.emplace_back(std::move(edges), length > 0.0 ? sum / length : mesh.points[top]);
  }
  return loops;
}

void measure(const TriangleMesh& mesh, MeshPart& part) {
  const glm::dvec3 origin = mesh.points[mesh.triangles[part.triangles.front()][0]];
  const auto six_volumes = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::dot(a - origin, glm::cross(b - origin, c - origin));
  };
  double sum = 0.0;
  for (const uint32_t i : part.triangles) {
    const TriangleMesh::Triangle& t = mesh.triangles[i];
    sum += six_volumes(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    const glm::dvec3 normal = 0.5 * normal_of(mesh, i);
    part.area_m2 += glm::length(normal);
    part.facing_m2 += normal;
  }
  for (const auto& [edges, middle] : loops_of(mesh, part.open))
    for (const EdgeUse& use : edges) {
      const glm::dvec3& from = mesh.points[use.forward ? use.b : use.a];
      const glm::dvec3& to = mesh.points[use.forward ? use.a : use.b];
      sum += six_volumes(from, to, middle);
      part.caps_m2 += 0.5 * glm::length(glm::cross(from - middle, to - middle));
    }
  part.volume_m3 = sum / 6.0;
}

}  // namespace

std::vector<MeshPart> parts_of(TriangleMesh& mesh, double tolerance_m, PartFindings& found) {
  Patches patches(mesh, tolerance_m);
  found.turned_triangles = patches.turned();
  std::vector<MeshPart> parts = patches.parts();
  for (MeshPart& part : parts) measure(mesh, part);
  turn_insides_in(mesh, parts, found);
  return parts;
}

TriangleMesh part_mesh(const TriangleMesh& mesh, const std::vector<uint32_t>& triangles) {
  TriangleMesh part;
  part.name = mesh.name;
  std::vector<uint32_t> points;
  for (const uint32_t i : triangles)
    for (const uint32_t corner : mesh.triangles[i]) points.push_back(corner);
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (const uint32_t point : points) part.points.push_back(mesh.points[point]);
  for (const uint32_t i : triangles) {
    TriangleMesh::Triangle t = mesh.triangles[i];
    for (uint32_t& corner : t)
      corner = static_cast<uint32_t>(std::ranges::lower_bound(points, corner) - points.begin());
    part.add(t, mesh.material_of(i));
  }
  return part;
}

}  // namespace scree
