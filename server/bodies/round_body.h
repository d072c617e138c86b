// Bodies that are round, by all their points as balls are, or about an axis as capsules and cylinders. A hull
// of a few corners would rock from face to face, and not begin to roll on a slope that is flatter than half
// of a face's angle. Private to this folder.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "server/colliders/terrain_collider.h"
#include "server/formats/world_value.h"

namespace scree {

/// How a round body touches the ground.
struct Roundness {
  float radius_m = 0.0F;        ///< 0: it is not round
  float sag_m = 0.0F;           ///< the most by which the hull of its points lies within the ball
  glm::vec3 half_axis_m{0.0F};  ///< of a roller, from its middle to an end of its axis; 0: it is a ball
  bool ends_round = false;      ///< a roller is a capsule, not a cylinder

  bool is_roller() const { return half_axis_m != glm::vec3(0.0F); }
};

/// By points of its surface, about its centre of mass: all as far from there, and none far from its
/// neighbours.
Roundness roundness_of(const std::vector<glm::vec3>& points_m);

/// The roundness of a prop of one part that is a capsule or a cylinder, in the shape's axes. A hull of the
/// same corners as a cylinder is one, too.
Roundness roller_of(const BodyShape& shape);

/// Moves contacts of single points of a round body to where the ball touches that ground; the body has so
/// many points.
void touch_as_ball(const Roundness& ball, int points, std::vector<TerrainContact>& contacts);
/// The same of a roller, whose axis is in the world's axes. A cylinder keeps contacts of its ends' faces.
void touch_as_roller(const Roundness& roller, glm::vec3 half_axis_m, int points,
                     std::vector<TerrainContact>& contacts);

}  // namespace scree
