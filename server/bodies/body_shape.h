// From the hull of a piece to what collides: Bullet's shrunken hull, and the points tested against terrain.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace scree {

/// Bullet surrounds a convex shape with a margin; the hull is shrunk by it and a little more, so that
/// neighbours do not overlap at birth. For piece against piece alone.
/// `middle_m` must lie inside.
std::unique_ptr<btConvexHullShape> make_convex_shape(const std::vector<glm::vec3>& hull_m,
                                                     glm::vec3 middle_m = glm::vec3(0.0F));

/// The shrunken hull's corners.
std::vector<glm::vec3> corners_of(const btConvexHullShape& shape);

/// The hull's corners, and points on its faces so that none lie much farther apart than the spacing.
std::vector<glm::vec3> surface_points(const std::vector<glm::vec3>& hull_m, float spacing_m);

/// Radius about the origin that holds the points.
float radius_of(const std::vector<glm::vec3>& points_m);

}  // namespace scree
