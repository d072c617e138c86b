// A pose between two known ones.
#pragma once

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include "shared/field/piece.h"

namespace scree {

/// `t`: 0 gives the first, 1 the second.
inline Pose pose_between(const Pose& from, const Pose& to, float t) {
  return {glm::mix(from.position_m, to.position_m, t), glm::slerp(from.rotation, to.rotation, t)};
}

}  // namespace scree
