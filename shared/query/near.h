// Nearest places of points, segments and triangles, and when a moving ball touches a triangle. Lengths of any
// one unit. + − × ÷ and sqrt alone (Ericson 2005, "Real-Time Collision Detection", 5.1).
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

#include "shared/query/surface_ray.h"

namespace scree {

using Corners = std::array<glm::dvec3, 3>;

glm::dvec3 nearest_on_segment(const glm::dvec3& place, const glm::dvec3& a, const glm::dvec3& b);

/// Also of a triangle without area.
glm::dvec3 nearest_on_triangle(const glm::dvec3& place, const Corners& corners);

/// The nearest places of two shapes to each other, and the square of their distance.
struct NearPair {
  glm::dvec3 on_first{0.0};
  glm::dvec3 on_second{0.0};
  double squared = 0.0;
};

NearPair nearest_of_segments(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                             const glm::dvec3& d);

/// The first is the segment, which may be a point. Squared is 0 where they cross.
NearPair nearest_of_segment_and_triangle(const glm::dvec3& a, const glm::dvec3& b, const Corners& corners);

/// How far a ball moves along a line until it touches a triangle that it does not touch at first, `most` at
/// most.
std::optional<double> touch_of_ball(const Line& line, double most, double radius, const Corners& corners);

/// The same of all places of a segment from the line's place to that place + axis. Exact: a ball against the
/// prism that the triangle sweeps along −axis.
std::optional<double> touch_of_capsule(const Line& line, const glm::dvec3& axis, double most, double radius,
                                       const Corners& corners);

}  // namespace scree
