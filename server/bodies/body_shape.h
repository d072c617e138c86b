// Makes the colliding shapes of a piece from its hull: Bullet's shrunken hull for other bodies, and points
// for the terrain. Metres.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "server/bodies/limits.h"

namespace scree {

/// The hull's corners, shrunk towards `middle_m` by Bullet's margin around a convex shape and by a gap, so
/// that pieces do not overlap at birth. Collides with other bodies only. The hull has at least 4 corners, and
/// `middle_m` lies inside it.
std::unique_ptr<btConvexHullShape> make_convex_shape(const std::vector<glm::vec3>& hull_m,
                                                     glm::vec3 middle_m = glm::vec3(0.0F),
                                                     float gap_m = limits::birth_gap_m);

/// The hull of these points, one at least, grown by a ball of that radius, which is positive. It is not
/// shrunk.
std::unique_ptr<btConvexHullShape> make_rounded_shape(const std::vector<glm::vec3>& points_m, float radius_m);

/// Distance of the hull's nearest face from a point inside, estimated from above.
float thickness_of(const std::vector<glm::vec3>& hull_m, glm::vec3 middle_m);

/// The shrunken hull's corners.
std::vector<glm::vec3> corners_of(const btConvexHullShape& shape);

/// The hull's corners, and points on its faces at most about `spacing_m` apart. `hull_m` must not be empty;
/// the spacing is positive, and doubles until there are at most limits::samples_max points.
std::vector<glm::vec3> surface_points(const std::vector<glm::vec3>& hull_m, float spacing_m);

/// Radius of the sphere about the origin that holds the points.
float radius_of(const std::vector<glm::vec3>& points_m);

}  // namespace scree
