// Moves a camera by the person's input. No window.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "client/render/scene/camera.h"

namespace scree {

/// The input of one frame.
struct FlyInput {
  glm::vec3 move{0.0F};  ///< right, up, forward, as parts of the full speed; together at most that
  bool fast = false;
  glm::vec2 turn{0.0F};  ///< mouse, pixels to the right and down
};

/// The turn of a frame by keys: right and down, −1 to 1.
glm::vec2 turn_by_keys(glm::vec2 keys, float elapsed_s);

/// Stays within the world and short of straight up and down.
void fly(Camera& camera, const FlyInput& input, float elapsed_s);

}  // namespace scree
