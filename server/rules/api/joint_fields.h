// A joint as scripts ask for it: by places of the world, where its bodies are now.
#pragma once

#include "server/rules/fields.h"
#include "shared/prop/joint.h"

namespace scree {

struct WantedJoint {
  Joint nature;  ///< its kind, limits, motor, … ; sides and length follow from the rest
  PieceId a = 0, b = 0;
  glm::vec3 place_m{0.0F}, other_place_m{0.0F};
  glm::vec3 axis{0.0F, 1.0F, 0.0F};
};

extern const FieldTable wanted_joint_fields;

/// The joint of bodies as they stand. Refuses one of a body that is not there.
Result<Joint> joint_of(const WantedJoint& wanted, const World& world);

}  // namespace scree
