// Internal to import/mesh.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <utility>

namespace scree {

/// From p to the triangle, metres.
double distance_to(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Which places may be within a distance of a triangle, by rows along z: those between its two planes and its
/// three edges, all moved outwards. A slender triangle that lies askew fills little of the box around it.
class NearRows {
 public:
  NearRows(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double reach_m);

  /// The first and the last z of the row at x and y, metres; first > last: none. Outside them, each place is
  /// farther.
  std::pair<double, double> at(double x_m, double y_m) const;

 private:
  /// dot(normal, p) <= most.
  struct Side {
    glm::dvec3 normal{};
    double most = 1e300;
  };
  std::array<Side, 5> sides_{};
};

}  // namespace scree
