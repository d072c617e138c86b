// The body of a person as limbs: it stands under its eye, walks by how far it went, holds a tool, and looks
// where the person looks. Metres.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "client/render/scene/limb.h"
#include "client/render/scene/line_list.h"

namespace scree {

struct PersonPose {
  glm::vec3 eye_m{0.0F};
  glm::vec3 look{0.0F, 0.0F, -1.0F};  ///< unit
  float walked_m = 0.0F;              ///< over the ground, forwards: decides where the legs are
  float speed_m_s = 0.0F;             ///< over the ground
  bool stands = true;                 ///< or it flies
};

/// Adds the limbs. What is worn has that colour.
void add_person(std::vector<Limb>& limbs, const PersonPose& pose, LineColour colour);

}  // namespace scree
