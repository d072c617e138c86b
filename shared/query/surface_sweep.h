// Balls and capsules against the polygons of a surface: the nearest place, and the first one on a way.
// Units: voxels. + − × ÷ and sqrt alone.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "shared/query/convex.h"
#include "shared/query/near.h"

namespace scree {

/// The nearest of the surface to a segment, which may be a point.
struct SurfaceNear {
  NearPair pair;           ///< the segment first
  glm::dvec3 normal{0.0};  ///< of the polygon, out of the rock, of length 1; zero where it has no area
};

/// Nothing when it is farther than `most`. `steps` counts blocks and polygons, here and below.
std::optional<SurfaceNear> nearest_of_surface(CellSource& cells, const glm::dvec3& from,
                                              const glm::dvec3& axis, double most, uint32_t& steps);

/// A ball, or with an axis a capsule from the line's place to that place + axis, that moves along a line.
struct Mover {
  Line line;
  glm::dvec3 axis{0.0};
  double radius = 0.0;
};

struct SweptHit {
  SurfaceHit hit;       ///< the normal points from the place to the mover's middle, of length 1
  bool inside = false;  ///< the mover begins in the surface, or in rock; the hit is at 0 then
};

/// A mover that only touches a surface at first, within touch_slack, may slide along it and leave it.
std::optional<SweptHit> first_of_mover(CellSource& cells, const Mover& mover, double most, uint32_t& steps);

/// Whether a rounded hull has a place of the surface in it. What lies wholly in rock has none.
bool meets_surface(CellSource& cells, const Rounded& hull, uint32_t& steps);

inline constexpr double touch_slack = 1.0 / 1024.0;

}  // namespace scree
