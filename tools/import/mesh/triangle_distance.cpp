#include "tools/import/mesh/triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace scree {

// By the place on the triangle nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
double distance_to(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return glm::length(ap);
  const glm::dvec3 bp = p - b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return glm::length(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return glm::length(ap - ab * (d1 / (d1 - d3)));
  const glm::dvec3 cp = p - c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return glm::length(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return glm::length(ap - ac * (d2 / (d2 - d6)));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return glm::length(bp - (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  const glm::dvec3 normal = glm::cross(ab, ac);
  return std::abs(glm::dot(ap, normal)) / glm::length(normal);
}

NearRows::NearRows(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double reach_m) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double twice_area = glm::length(normal);
  const std::array<std::pair<glm::dvec3, glm::dvec3>, 3> edges = {{{a, b}, {b, c}, {c, a}}};
  double longest = 0.0;
  for (const auto& [from, to] : edges) longest = std::max(longest, glm::length(to - from));
  // The directions of a needle are rounding alone: no side bounds it.
  constexpr double needle = 1e-9;
  if (!(twice_area > needle * longest * longest)) return;
  const glm::dvec3 up = normal / twice_area;
  sides_[0] = {up, glm::dot(up, a) + reach_m};
  sides_[1] = {-up, reach_m - glm::dot(up, a)};
  for (size_t k = 0; k < edges.size(); ++k) {
    const auto& [from, to] = edges[k];
    const glm::dvec3 outwards = glm::normalize(glm::cross(to - from, up));
    sides_[2 + k] = {outwards, glm::dot(outwards, from) + reach_m};
  }
}

std::pair<double, double> NearRows::at(double x_m, double y_m) const {
  double first = -1e300, last = 1e300;
  for (const Side& side : sides_) {
    const double left = side.most - side.normal.x * x_m - side.normal.y * y_m;
    if (side.normal.z > 0.0)
      last = std::min(last, left / side.normal.z);
    else if (side.normal.z < 0.0)
      first = std::max(first, left / side.normal.z);
    else if (left < 0.0)
      return {1.0, -1.0};
  }
  return {first, last};
}

}  // namespace scree
