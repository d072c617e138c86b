#include "shared/query/convex.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/query/limits.h"
#include "shared/query/vectors.h"

namespace scree {

namespace {

/// A corner of the difference of two hulls, and the points that it is the difference of.
struct Difference {
  size_t first = 0;
  size_t second = 0;
  glm::dvec3 v{0.0};
};

/// Corners, and how much of each the place has that is nearest to the origin.
struct Simplex {
  std::array<Difference, 4> corners;
  std::array<double, 4> weights{};
  int count = 0;

  glm::dvec3 place() const {
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < static_cast<size_t>(count); ++i) sum += corners[i].v * weights[i];
    return sum;
  }
};

double square(const glm::dvec3& v) {
  return glm::dot(v, v);
}

Simplex nearest_in(const Difference& a) {
  return {{a}, {1.0}, 1};
}

Simplex nearest_in(const Difference& a, const Difference& b) {
  const glm::dvec3 edge = b.v - a.v;
  const double along = -glm::dot(a.v, edge), length = square(edge);
  if (along <= 0.0 || length == 0.0) return nearest_in(a);
  if (along >= length) return nearest_in(b);
  return {{a, b}, {1.0 - along / length, along / length}, 2};
}

const Simplex& nearer(const Simplex& a, const Simplex& b) {
  return square(b.place()) < square(a.place()) ? b : a;
}

Simplex nearest_in(const Difference& a, const Difference& b, const Difference& c) {
  const glm::dvec3 out = glm::cross(b.v - a.v, c.v - a.v);
  const double for_a = glm::dot(glm::cross(b.v, c.v), out), for_b = glm::dot(glm::cross(c.v, a.v), out);
  const double for_c = glm::dot(glm::cross(a.v, b.v), out), sum = for_a + for_b + for_c;
  if (for_a > 0.0 && for_b > 0.0 && for_c > 0.0 && sum > 0.0)
    return {{a, b, c}, {for_a / sum, for_b / sum, for_c / sum}, 3};
  return nearer(nearer(nearest_in(a, b), nearest_in(b, c)), nearest_in(c, a));
}

/// Nothing where the origin lies within.
std::optional<Simplex> nearest_in(const std::array<Difference, 4>& corners) {
  std::optional<Simplex> best;
  for (size_t left_out = 0; left_out < 4; ++left_out) {
    const Difference& a = corners[(left_out + 1) % 4];
    const Difference& b = corners[(left_out + 2) % 4];
    const Difference& c = corners[(left_out + 3) % 4];
    const glm::dvec3 out = glm::cross(b.v - a.v, c.v - a.v);
    const double inner = glm::dot(corners[left_out].v - a.v, out), origin = -glm::dot(a.v, out);
    const bool is_flat = inner * inner <= 1e-20 * square(out) * square(corners[left_out].v - a.v);
    if (!is_flat && inner * origin > 0.0) continue;
    const Simplex face = nearest_in(a, b, c);
    best = best ? nearer(*best, face) : face;
  }
  return best;
}

std::optional<Simplex> nearest_in(const Simplex& simplex, const Difference& added) {
  const auto& [a, b, c, d] = simplex.corners;
  switch (simplex.count) {
    case 1:
      return nearest_in(a, added);
    case 2:
      return nearest_in(a, b, added);
    default:
      return nearest_in({a, b, c, added});
  }
}

size_t farthest(std::span<const glm::dvec3> points, const glm::dvec3& direction) {
  size_t best = 0;
  double most = glm::dot(points[0], direction);
  for (size_t i = 1; i < points.size(); ++i) {
    const double along = glm::dot(points[i], direction);
    if (along <= most) continue;
    most = along;
    best = i;
  }
  return best;
}

/// Two hulls, the first of which is moved by `by`. Nothing where they meet.
std::optional<Simplex> nearest_difference(std::span<const glm::dvec3> first, const glm::dvec3& by,
                                          std::span<const glm::dvec3> second, uint32_t& steps) {
  constexpr double close_enough = 1e-12;
  const auto difference = [&](const glm::dvec3& away) {
    const size_t a = farthest(first, away), b = farthest(second, -away);
    return Difference{a, b, first[a] + by - second[b]};
  };
  Simplex simplex = nearest_in(Difference{0, 0, first[0] + by - second[0]});
  glm::dvec3 place = simplex.corners[0].v;
  double largest = square(place);
  for (int round = 0; round < limits::query_distance_rounds; ++round) {
    ++steps;
    const double now = square(place);
    if (now <= 1e-24 * largest) return std::nullopt;
    const Difference added = difference(-place);
    largest = std::max(largest, square(added.v));
    if (now - glm::dot(place, added.v) <= close_enough * now) break;
    const auto end = simplex.corners.begin() + simplex.count;
    if (std::any_of(simplex.corners.begin(), end, [&](const Difference& corner) {
          return corner.first == added.first && corner.second == added.second;
        }))
      break;
    const std::optional<Simplex> next = nearest_in(simplex, added);
    if (!next) return std::nullopt;
    const glm::dvec3 next_place = next->place();
    if (square(next_place) >= now) break;
    simplex = *next;
    place = next_place;
  }
  return simplex;
}

ConvexNear nearest_of_moved(const Rounded& first, const glm::dvec3& by, const Rounded& second,
                            uint32_t& steps) {
  CHECK(!first.points.empty() && !second.points.empty());
  const auto simplex = nearest_difference(first.points, by, second.points, steps);
  ConvexNear near;
  if (!simplex) {
    near.meet = true;
    return near;
  }
  for (size_t i = 0; i < static_cast<size_t>(simplex->count); ++i) {
    near.on_first += (first.points[simplex->corners[i].first] + by) * simplex->weights[i];
    near.on_second += second.points[simplex->corners[i].second] * simplex->weights[i];
  }
  const glm::dvec3 place = simplex->place();
  const double distance = std::sqrt(square(place));
  near.normal = place / distance;
  near.gap = distance - first.radius - second.radius;
  near.on_first -= near.normal * first.radius;
  near.on_second += near.normal * second.radius;
  return near;
}

bool is_within(float x, float most) {
  return x >= -most && x <= most;  // not of a NaN
}

}  // namespace

Convex convex_sphere(glm::vec3 centre_m, float radius_m) {
  return {{centre_m}, radius_m};
}

Convex convex_capsule(glm::vec3 from_m, glm::vec3 to_m, float radius_m) {
  return {{from_m, to_m}, radius_m};
}

Convex convex_box(glm::vec3 centre_m, glm::vec3 half_extents_m) {
  Convex convex;
  for (int i = 0; i < 8; ++i)
    convex.points_m.push_back(centre_m + half_extents_m * glm::vec3((i & 4) != 0 ? 1.0F : -1.0F,
                                                                    (i & 2) != 0 ? 1.0F : -1.0F,
                                                                    (i & 1) != 0 ? 1.0F : -1.0F));
  return convex;
}

Convex convex_cylinder(glm::vec3 centre_m, float radius_m, float half_height_m) {
  // Halving the angles of a quarter twice makes sixteen sides, without sines.
  std::vector<glm::dvec3> ring{{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};
  for (int i = 0; i < 2; ++i) {
    std::vector<glm::dvec3> finer;
    for (size_t k = 0; k < ring.size(); ++k) {
      finer.push_back(ring[k]);
      finer.push_back(unit_of(ring[k] + ring[(k + 1) % ring.size()]));
    }
    ring = std::move(finer);
  }
  Convex convex;
  for (const float height : {-half_height_m, half_height_m})
    for (const glm::dvec3& at : ring)
      convex.points_m.push_back(centre_m + glm::vec3(at) * radius_m + glm::vec3(0.0F, height, 0.0F));
  return convex;
}

Result<void> validate(const Convex& convex) {
  constexpr float most = limits::query_part_reach_max_m;
  if (convex.points_m.empty()) return fail("a convex part has no points");
  if (convex.points_m.size() > limits::query_points_max)
    return fail("a convex part has more points than limits.query_points_max");
  for (const glm::vec3& point : convex.points_m)
    if (!is_within(point.x, most) || !is_within(point.y, most) || !is_within(point.z, most))
      return fail(
          "a point of a convex part is farther away than limits.query_part_reach_max_m, or no number");
  if (!(convex.radius_m >= 0.0F && convex.radius_m <= most))
    return fail("the radius of a convex part is negative, too large or no number");
  return {};
}

ConvexNear nearest_of_convex(const Rounded& first, const Rounded& second, uint32_t& steps) {
  return nearest_of_moved(first, glm::dvec3(0.0), second, steps);
}

ConvexNear nearest_of_convex(const glm::dvec3& place, const Rounded& convex, uint32_t& steps) {
  return nearest_of_moved({std::span(&place, 1), 0.0}, glm::dvec3(0.0), convex, steps);
}

std::optional<ConvexHit> first_of_convex(const Rounded& moving, const glm::dvec3& unit, double most,
                                         const Rounded& standing, double slack, uint32_t& steps) {
  ConvexHit hit;
  for (int advance = 0; advance < limits::query_advances; ++advance) {
    const ConvexNear near = nearest_of_moved(moving, unit * hit.along, standing, steps);
    if (near.meet || near.gap < -slack) {
      // Later on rounding alone brings one here: the places of the round before hold.
      hit.inside = advance == 0;
      return hit;
    }
    hit.place = near.on_second;
    hit.normal = near.normal;
    // The plane between them parts them for good where they do not close in.
    const double closing = -glm::dot(unit, near.normal);
    if (closing <= 0.0) return std::nullopt;
    if (near.gap <= slack) return hit;
    const double next = hit.along + (near.gap - slack * 0.5) / closing;
    if (next > most) return std::nullopt;
    hit.along = next;
  }
  return hit;
}

}  // namespace scree
