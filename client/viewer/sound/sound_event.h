// What makes a sound in the world.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "shared/field/material.h"

namespace scree {

enum class SoundKind : uint8_t { strike, crack, settle };

struct SoundEvent {
  SoundKind kind = SoundKind::strike;
  glm::vec3 place_m{0.0F};
  float size_m = 1.0F;       ///< side of a cube of its volume
  float impulse_n_s = 0.0F;  ///< that it had, gave or lost
  Material material = Material::rock;
};

/// Who hears it: `right` is a unit vector.
struct Ears {
  glm::vec3 place_m{0.0F};
  glm::vec3 right{1.0F, 0.0F, 0.0F};
};

}  // namespace scree
