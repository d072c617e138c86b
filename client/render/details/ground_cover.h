// What covers the ground where nobody touched it: the same noise, and the same decision between rock, sand,
// scrub and snow, as weathered() in client/shaders/rock.glsl makes it for each pixel. Pure.
#pragma once

#include <glm/vec3.hpp>

namespace scree {

struct GroundCover {
  float flat = 0.0F;   ///< 1: sand or scrub lies here; 0: bare rock
  float green = 0.0F;  ///< 1: scrub; 0: sand
  float snow = 0.0F;
  float fine = 0.0F;  ///< brightness by small places, 0 to 1
};

/// At a place, metres, whose surface has that normal. Snow lies above `ice_above_m`.
GroundCover ground_cover(glm::vec3 place_m, glm::vec3 normal, float ice_above_m);

}  // namespace scree
