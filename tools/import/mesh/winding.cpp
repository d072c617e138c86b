#include "tools/import/mesh/winding.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "tools/import/mesh/triangle_distance.h"

namespace scree {

namespace {

constexpr uint32_t leaf_triangles = 8;
/// A node counts as one dipole from this many of its radii on; errors are then below a hundredth.
constexpr double far_radii = 2.0;
/// A triangle is slender from this ratio of its length to its height on.
constexpr double slender = 8.0;
/// Times that a triangle is halved at most, and pieces for each triangle of the mesh in the mean.
constexpr int halvings_max = 8;
constexpr size_t pieces_a_triangle = 8;
constexpr double full_angle = 4.0 * M_PI;

/// Van Oosterom and Strackee 1983.
double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), below);
}

/// On the inner side of its plane, or on it.
bool is_behind(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
  return glm::dot(p - t[0], glm::cross(t[1] - t[0], t[2] - t[0])) <= 0.0;
}

}  // namespace

WindingTree::WindingTree(const TriangleMesh& mesh) {
  const size_t pieces_max = pieces_a_triangle * mesh.triangles.size();
  std::vector<uint32_t> owners;
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const TriangleMesh::Triangle& t = mesh.triangles[i];
    add_pieces({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, halvings_max, pieces_max);
    owners.resize(triangles_.size(), i);
  }
  numbers_.resize(triangles_.size());
  std::iota(numbers_.begin(), numbers_.end(), 0U);
  if (!triangles_.empty()) build(0, static_cast<uint32_t>(triangles_.size()));
  std::vector<Corners> sorted;
  sorted.reserve(triangles_.size());
  for (uint32_t& number : numbers_) {
    sorted.push_back(triangles_[number]);
    number = owners[number];
  }
  triangles_ = std::move(sorted);
}

/// Slender triangles make nodes large, and large nodes are far from nowhere: they are halved.
void WindingTree::add_pieces(const Corners& t, int halvings, size_t pieces_max) {
  size_t longest = 0;
  double length = -1.0;
  for (size_t k = 0; k < 3; ++k)
    if (const double own = glm::length(t[(k + 1) % 3] - t[k]); own > length) {
      length = own;
      longest = k;
    }
  const double twice_area = glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
  const bool is_slender = length * length > slender * twice_area && twice_area > 0.0;
  if (!is_slender || halvings == 0 || triangles_.size() >= pieces_max) {
    triangles_.push_back(t);
    return;
  }
  const glm::dvec3 &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
  const glm::dvec3 middle = 0.5 * (a + b);
  add_pieces({a, middle, c}, halvings - 1, pieces_max);
  add_pieces({middle, b, c}, halvings - 1, pieces_max);
}

uint32_t WindingTree::build(uint32_t first, uint32_t count) {
  const auto index = static_cast<uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node{{}, {}, 0.0, first, count, 0};
  double area = 0.0;
  glm::dvec3 lo(1e300), hi(-1e300);
  for (uint32_t i = first; i < first + count; ++i) {
    const Corners& t = triangles_[numbers_[i]];
    const glm::dvec3 normal = 0.5 * glm::cross(t[1] - t[0], t[2] - t[0]);
    const double own = glm::length(normal);
    node.normal += normal;
    node.centre += own * (t[0] + t[1] + t[2]) / 3.0;
    area += own;
    for (const glm::dvec3& p : t) lo = glm::min(lo, p), hi = glm::max(hi, p);
  }
  node.centre = area > 0.0 ? node.centre / area : 0.5 * (lo + hi);
  for (uint32_t i = first; i < first + count; ++i)
    for (const glm::dvec3& p : triangles_[numbers_[i]])
      node.radius = std::max(node.radius, glm::length(p - node.centre));
  if (count > leaf_triangles) {
    const glm::dvec3 size = hi - lo;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const auto begin = numbers_.begin() + first;
    const auto middle = [&](uint32_t i) {
      const Corners& t = triangles_[i];
      return std::pair(t[0][axis] + t[1][axis] + t[2][axis], i);
    };
    std::nth_element(begin, begin + count / 2, begin + count,
                     [&](uint32_t one, uint32_t other) { return middle(one) < middle(other); });
    build(first, count / 2);
    node.right = build(first + count / 2, count - count / 2);
  }
  nodes_[index] = node;
  return index;
}

double WindingTree::winding(const glm::dvec3& p) const {
  return nodes_.empty() ? 0.0 : winding(0, p) / full_angle;
}

WindingTree::Nearest WindingTree::nearest(const glm::dvec3& p) const {
  Nearest best;
  find_nearest(0, p, Side::any, best);
  return best;
}

uint32_t WindingTree::owner(const glm::dvec3& p) const {
  const Nearest of_any = nearest(p);
  if (of_any.is_behind || !(winding(p) > 0.5)) return of_any.triangle;
  Nearest behind;
  find_nearest(0, p, Side::behind, behind);
  return behind.distance < none ? behind.triangle : of_any.triangle;
}

bool WindingTree::reaches(const Node& node, const glm::dvec3& p, double reach) const {
  return glm::length(node.centre - p) - node.radius <= reach;
}

void WindingTree::find_nearest(uint32_t at, const glm::dvec3& p, Side side, Nearest& best) const {
  const Node& node = nodes_[at];
  if (glm::length(node.centre - p) - node.radius > best.distance) return;
  if (node.right == 0) {
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Corners& t = triangles_[i];
      const double distance = distance_to(p, t[0], t[1], t[2]);
      if (std::pair(distance, numbers_[i]) >= std::pair(best.distance, best.triangle)) continue;
      const bool behind = is_behind(p, t);
      if (side == Side::any || behind) best = {distance, numbers_[i], behind};
    }
    return;
  }
  const bool right_first =
      glm::length(nodes_[node.right].centre - p) < glm::length(nodes_[at + 1].centre - p);
  find_nearest(right_first ? node.right : at + 1, p, side, best);
  find_nearest(right_first ? at + 1 : node.right, p, side, best);
}

double WindingTree::winding(uint32_t at, const glm::dvec3& p) const {
  const Node& node = nodes_[at];
  const glm::dvec3 to = node.centre - p;
  const double distance = glm::length(to);
  if (distance > far_radii * node.radius) return glm::dot(to, node.normal) / (distance * distance * distance);
  if (node.right != 0) return winding(at + 1, p) + winding(node.right, p);
  double sum = 0.0;
  for (uint32_t i = node.first; i < node.first + node.count; ++i)
    sum += solid_angle(triangles_[i][0] - p, triangles_[i][1] - p, triangles_[i][2] - p);
  return sum;
}

}  // namespace scree
