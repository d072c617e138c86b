// Bodies that are round by all their points, which roll as balls do. A hull of a few corners would rock from
// face to face, and not begin to roll on a slope that is flatter than half of a face's angle. Private to this
// folder.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "server/colliders/terrain_collider.h"

namespace scree {

/// How a round body touches the ground.
struct Roundness {
  float radius_m = 0.0F;  ///< 0: it is not round
  float sag_m = 0.0F;     ///< the most by which the hull of its points lies within the ball
};

/// By points of its surface, about its centre of mass: all as far from there, and none far from its
/// neighbours.
Roundness roundness_of(const std::vector<glm::vec3>& points_m);

/// Moves contacts of single points of a round body to where the ball touches that ground; the body has so
/// many points.
void touch_as_ball(const Roundness& ball, int points, std::vector<TerrainContact>& contacts);

}  // namespace scree
