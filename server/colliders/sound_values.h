// Predicates of vectors and poses for this folder's checks: a NaN fails all of them.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "shared/field/piece.h"

namespace scree {

/// Length within 0.1 % of 1: normals come from single-precision divisions.
inline bool is_unit(glm::vec3 v) {
  return std::abs(glm::dot(v, v) - 1.0F) < 2e-3F;
}

inline bool is_sound(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A finite position and a unit quaternion.
inline bool is_sound(const Pose& pose) {
  return is_sound(pose.position_m) && std::abs(glm::dot(pose.rotation, pose.rotation) - 1.0F) < 2e-3F;
}

}  // namespace scree
