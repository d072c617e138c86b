// Converts vectors and poses between GLM and Bullet. Private to this folder.
#pragma once

#include <LinearMath/btTransform.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "shared/field/piece.h"

namespace scree {

inline btVector3 to_bullet(glm::vec3 v) {
  return {v.x, v.y, v.z};
}

inline glm::vec3 from_bullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

inline btTransform to_bullet(const Pose& pose) {
  const glm::quat& q = pose.rotation;
  return btTransform(btQuaternion(q.x, q.y, q.z, q.w), to_bullet(pose.position_m));
}

inline glm::mat3 from_bullet(const btMatrix3x3& rows) {
  return {from_bullet(rows.getColumn(0)), from_bullet(rows.getColumn(1)), from_bullet(rows.getColumn(2))};
}

inline Pose from_bullet(const btTransform& transform) {
  const btQuaternion q = transform.getRotation();
  return {from_bullet(transform.getOrigin()), glm::quat(q.w(), q.x(), q.y(), q.z())};
}

}  // namespace scree
