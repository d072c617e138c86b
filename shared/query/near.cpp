#include "shared/query/near.h"

#include <algorithm>
#include <cmath>

#include "shared/query/vectors.h"

namespace scree {

namespace {

double squared(const glm::dvec3& v) {
  return glm::dot(v, v);
}

/// When a ball's centre comes to `radius` from a place, from outside; nothing when it does not.
std::optional<double> touch_of_point(const Line& line, double radius, const glm::dvec3& place) {
  const glm::dvec3 off = line.from - place;
  const double towards = glm::dot(off, line.unit), beyond = squared(off) - radius * radius;
  const double under_root = towards * towards - beyond;
  if (towards >= 0.0 || under_root < 0.0) return std::nullopt;
  return -towards - std::sqrt(under_root);
}

/// The same from the inner places of a segment.
std::optional<double> touch_of_edge(const Line& line, double radius, const glm::dvec3& a,
                                    const glm::dvec3& b) {
  const glm::dvec3 edge = b - a, off = line.from - a;
  const double length = squared(edge);
  if (length == 0.0) return std::nullopt;
  // Both without their parts along the edge.
  const double part = glm::dot(line.unit, edge) / length, start = glm::dot(off, edge) / length;
  const glm::dvec3 speed = line.unit - edge * part, gap = off - edge * start;
  const double square = squared(speed), towards = glm::dot(gap, speed);
  const double under_root = towards * towards - square * (squared(gap) - radius * radius);
  if (square < 1e-18 || towards >= 0.0 || under_root < 0.0) return std::nullopt;
  const double along = (-towards - std::sqrt(under_root)) / square;
  const double at = start + part * along;
  return at < 0.0 || at > 1.0 ? std::nullopt : std::optional(along);
}

/// A triangle's plane, turned so that a line starts above it; `out` is zero for a triangle without area.
struct Plane {
  glm::dvec3 out{0.0};  ///< of length 1
  double height = 0.0;  ///< of the line's start
  double sinks = 0.0;   ///< along the line
  bool turned = false;
};

Plane plane_of(const Line& line, const Corners& corners) {
  Plane plane;
  const glm::dvec3 out = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double size = std::sqrt(squared(out));
  if (size == 0.0) return plane;
  plane.out = out / size;
  plane.height = glm::dot(line.from - corners[0], plane.out);
  plane.turned = plane.height < 0.0;
  if (plane.turned) {
    plane.out = -plane.out;
    plane.height = -plane.height;
  }
  plane.sinks = -glm::dot(line.unit, plane.out);
  return plane;
}

/// The same from the inner places of a triangle.
std::optional<double> touch_of_face(const Line& line, double radius, const Corners& corners,
                                    const Plane& plane) {
  if (plane.sinks <= 0.0 || plane.height < radius) return std::nullopt;
  const auto& [a, b, c] = corners;
  const double along = (plane.height - radius) / plane.sinks;
  const glm::dvec3 foot = line.at(along) - plane.out * radius;
  const double turn = plane.turned ? -1.0 : 1.0;
  const auto is_left = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, foot - from), plane.out) * turn >= 0.0;
  };
  return is_left(a, b) && is_left(b, c) && is_left(c, a) ? std::optional(along) : std::nullopt;
}

}  // namespace

glm::dvec3 nearest_on_segment(const glm::dvec3& place, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 edge = b - a;
  const double length = squared(edge);
  if (length == 0.0) return a;
  return a + edge * std::clamp(glm::dot(place - a, edge) / length, 0.0, 1.0);
}

glm::dvec3 nearest_on_triangle(const glm::dvec3& place, const Corners& corners) {
  const auto& [a, b, c] = corners;
  const glm::dvec3 ab = b - a, ac = c - a, ap = place - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const glm::dvec3 bp = place - b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const glm::dvec3 cp = place - c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double beside_c = d1 * d4 - d3 * d2, beside_b = d5 * d2 - d1 * d6, beside_a = d3 * d6 - d5 * d4;
  const double sum = beside_a + beside_b + beside_c;
  if (beside_a > 0.0 && beside_b > 0.0 && beside_c > 0.0 && sum > 0.0)
    return a + ab * (beside_b / sum) + ac * (beside_c / sum);
  // On an edge, or without area: the nearest of the three.
  glm::dvec3 best = nearest_on_segment(place, a, b);
  for (const glm::dvec3& other : {nearest_on_segment(place, b, c), nearest_on_segment(place, c, a)})
    if (squared(other - place) < squared(best - place)) best = other;
  return best;
}

NearPair nearest_of_segments(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                             const glm::dvec3& d) {
  const glm::dvec3 first = b - a, second = d - c, between = a - c;
  const double e = squared(first), f = squared(second), g = glm::dot(first, second);
  const double slope_first = glm::dot(first, between), slope_second = glm::dot(second, between);
  const double across_both = e * f - g * g;
  double s = 0.0;
  if (across_both > 1e-12 * e * f)
    s = std::clamp((g * slope_second - slope_first * f) / across_both, 0.0, 1.0);
  const double t = f > 0.0 ? std::clamp((g * s + slope_second) / f, 0.0, 1.0) : 0.0;
  if (e > 0.0) s = std::clamp((g * t - slope_first) / e, 0.0, 1.0);
  NearPair pair{a + first * s, c + second * t};
  pair.squared = squared(pair.on_first - pair.on_second);
  return pair;
}

NearPair nearest_of_segment_and_triangle(const glm::dvec3& a, const glm::dvec3& b, const Corners& corners) {
  NearPair best{a, nearest_on_triangle(a, corners)};
  best.squared = squared(best.on_first - best.on_second);
  if (a == b) return best;
  NearPair other{b, nearest_on_triangle(b, corners)};
  other.squared = squared(other.on_first - other.on_second);
  if (other.squared < best.squared) best = other;
  for (size_t i = 0; i < 3; ++i) {
    const NearPair edge = nearest_of_segments(a, b, corners[i], corners[(i + 1) % 3]);
    if (edge.squared < best.squared) best = edge;
  }
  const glm::dvec3 out = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double above = glm::dot(a - corners[0], out), below = glm::dot(b - corners[0], out);
  if ((above < 0.0) == (below < 0.0) || above == below) return best;
  const glm::dvec3 place = a + (b - a) * (above / (above - below));
  const auto is_left = [&](size_t i) {
    const glm::dvec3& from = corners[i];
    return glm::dot(glm::cross(corners[(i + 1) % 3] - from, place - from), out) >= 0.0;
  };
  return is_left(0) && is_left(1) && is_left(2) ? NearPair{place, place, 0.0} : best;
}

std::optional<double> touch_of_ball(const Line& line, double most, double radius, const Corners& corners) {
  const Plane plane = plane_of(line, corners);
  // It does not come as near as that to the plane.
  if (plane.height - std::max(plane.sinks, 0.0) * most > radius) return std::nullopt;
  // The inner places come first, if at all: they are where the line meets the face moved by the radius.
  std::optional<double> best = touch_of_face(line, radius, corners, plane);
  if (best) return *best <= most ? best : std::nullopt;
  const auto take = [&](const std::optional<double>& along) {
    if (along && *along >= 0.0 && *along <= most && (!best || *along < *best)) best = along;
  };
  for (size_t i = 0; i < 3; ++i) {
    take(touch_of_edge(line, radius, corners[i], corners[(i + 1) % 3]));
    take(touch_of_point(line, radius, corners[i]));
  }
  return best;
}

std::optional<double> touch_of_capsule(const Line& line, const glm::dvec3& axis, double most, double radius,
                                       const Corners& corners) {
  std::optional<double> best = touch_of_ball(line, most, radius, corners);
  if (axis == glm::dvec3(0.0)) return best;
  const auto take = [&](const Corners& part) {
    const auto along = touch_of_ball(line, best ? *best : most, radius, part);
    if (along) best = along;
  };
  const auto& [a, b, c] = corners;
  take({a - axis, b - axis, c - axis});
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &from = corners[i], &to = corners[(i + 1) % 3];
    take({from, to, to - axis});
    take({from, to - axis, from - axis});
  }
  return best;
}

}  // namespace scree
