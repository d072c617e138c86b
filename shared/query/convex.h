// Convex bodies: the hull of some points, rounded by a radius. A ball is one point, a capsule two, a box
// eight, a cylinder two rings of points. Distances by Gilbert, Johnson and Keerthi (1988); a moving body
// advances by its distance to the other one, against the plane between them (Mirtich 1996, conservative
// advancement; van den Bergen 2004). Pure, of + − × ÷ and sqrt alone; every loop is bounded. Lengths of any
// one unit.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "shared/base/result.h"

namespace scree {

struct Convex {
  std::vector<glm::vec3> points_m;
  float radius_m = 0.0F;

  bool operator==(const Convex&) const = default;
};

Convex convex_sphere(glm::vec3 centre_m, float radius_m);
Convex convex_capsule(glm::vec3 from_m, glm::vec3 to_m, float radius_m);
Convex convex_box(glm::vec3 centre_m, glm::vec3 half_extents_m);
/// Along y, with sixteen sides, whose corners are on the circle.
Convex convex_cylinder(glm::vec3 centre_m, float radius_m, float half_height_m);

/// Refuses no points, more than limits::query_points_max, numbers that are not finite, places farther than
/// limits::query_part_reach_max_m, a radius that is negative or as large.
Result<void> validate(const Convex& convex);

/// Points with a radius about them, in doubles, where somebody keeps the points.
struct Rounded {
  std::span<const glm::dvec3> points;
  double radius = 0.0;
};

/// The distance of two rounded hulls, the places where they are nearest, and the direction from the second's
/// place to the first's, of length 1. `gap` is negative where only the rounding of the two overlaps. Where
/// the hulls themselves meet, `meet` is true, the gap 0, and there is no direction.
struct ConvexNear {
  double gap = 0.0;
  bool meet = false;
  glm::dvec3 on_first{0.0};
  glm::dvec3 on_second{0.0};
  glm::dvec3 normal{0.0};
};
/// `steps` counts the rounds, here and below.
ConvexNear nearest_of_convex(const Rounded& first, const Rounded& second, uint32_t& steps);

/// The nearest place of a rounded hull to a place.
ConvexNear nearest_of_convex(const glm::dvec3& place, const Rounded& convex, uint32_t& steps);

struct ConvexHit {
  double along = 0.0;
  glm::dvec3 place{0.0};   ///< on the body that stands
  glm::dvec3 normal{0.0};  ///< towards the one that moves, of length 1
  bool inside = false;     ///< they overlap at first; `along` is 0 and the others mean nothing
};

/// How far the first moves along a direction of length 1 until it comes within `slack` of the second, which
/// stands, and how they touch then. Two that only touch at first, within the slack, may slide along each
/// other.
std::optional<ConvexHit> first_of_convex(const Rounded& moving, const glm::dvec3& unit, double most,
                                         const Rounded& standing, double slack, uint32_t& steps);

}  // namespace scree
