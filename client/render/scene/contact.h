// Where pieces and props keep the sky's light from what they lie on: each piece, and each part of a prop,
// counts as a ball of its volume. No GL.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "client/render/scene/draw_method.h"

namespace scree {

/// As it lies in the GPU's memory (contact_drawer.h). Metres.
struct Contact {
  glm::vec3 centre_m{0.0F};
  float radius_m = 0.0F;
};

/// At most limits::contacts_max, those nearest to the eye.
std::vector<Contact> contacts_of(const Scene& scene, glm::vec3 eye_m);

}  // namespace scree
