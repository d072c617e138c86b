#include "tools/import/mesh/edge_bound.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tools/import/mesh/box_tree.h"

namespace scree {

namespace {

/// Edges count together from so many of their radii on.
constexpr double together_radii = 2.0;

double distance_to_edge(const glm::dvec3& p, const OpenBody::Edge& edge) {
  const glm::dvec3 along = edge[1] - edge[0];
  const double squared = glm::dot(along, along);
  const double at = squared > 0.0 ? std::clamp(glm::dot(p - edge[0], along) / squared, 0.0, 1.0) : 0.0;
  return glm::length(edge[0] + at * along - p);
}

}  // namespace

EdgeBound::EdgeBound(const std::vector<OpenBody::Edge>& edges) {
  std::vector<OpenBody::Edge> sorted = edges;
  if (!sorted.empty()) build(sorted, 0, sorted.size());
}

void EdgeBound::build(std::vector<OpenBody::Edge>& edges, size_t first, size_t count) {
  const size_t index = nodes_.size();
  nodes_.emplace_back();
  Box3 box;
  Node node;
  for (size_t i = first; i < first + count; ++i) {
    box.add(edges[i][0]);
    box.add(edges[i][1]);
    node.length += glm::length(edges[i][1] - edges[i][0]);
  }
  node.centre = 0.5 * (box.lo + box.hi);
  node.radius = 0.5 * glm::length(box.hi - box.lo);
  node.edge = edges[first];
  if (count > 1) {
    const glm::dvec3 size = box.hi - box.lo;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const auto begin = edges.begin() + static_cast<std::ptrdiff_t>(first);
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(count / 2),
                     begin + static_cast<std::ptrdiff_t>(count), [axis](const auto& one, const auto& other) {
                       return one[0][axis] + one[1][axis] < other[0][axis] + other[1][axis];
                     });
    build(edges, first, count / 2);
    node.right = static_cast<uint32_t>(nodes_.size());
    build(edges, first + count / 2, count - count / 2);
  }
  nodes_[index] = node;
}

double EdgeBound::most_per_m(const glm::dvec3& centre, double radius_m) const {
  return nodes_.empty() ? 0.0 : sum(0, centre, radius_m) / (4.0 * M_PI);
}

double EdgeBound::sum(uint32_t at, const glm::dvec3& centre, double radius_m) const {
  const Node& node = nodes_[at];
  const bool leaf = node.right == 0;
  const double apart =
      (leaf ? distance_to_edge(centre, node.edge) : glm::length(node.centre - centre) - node.radius) -
      radius_m;
  if (leaf && !(apart > 0.0)) return std::numeric_limits<double>::infinity();
  // A straight edge, however long, gives at most 2 / distance.
  if (leaf) return std::min(node.length / (apart * apart), 2.0 / apart);
  if (apart > together_radii * node.radius) return node.length / (apart * apart);
  return sum(at + 1, centre, radius_m) + sum(node.right, centre, radius_m);
}

}  // namespace scree
