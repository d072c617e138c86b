// Vectors of doubles: what the questions' geometry needs of them, of + − × ÷ and sqrt alone.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "shared/base/check.h"

namespace scree {

/// Largest integer not above x, which must fit an int.
inline int floor_to_int(double x) {
  CHECK_DEBUG(x >= -2147483648.0 && x < 2147483648.0);
  const int i = static_cast<int>(x);
  return x < static_cast<double>(i) ? i - 1 : i;
}

/// The same direction of length 1. No vector without length.
inline glm::dvec3 unit_of(const glm::dvec3& v) {
  return v / std::sqrt(glm::dot(v, v));
}

/// A vector of length 1 across one of length 1: the axis that it follows least is made perpendicular to it.
inline glm::dvec3 across(const glm::dvec3& unit) {
  const glm::dvec3 size = glm::abs(unit);
  glm::dvec3 axis(0.0);
  if (size.x <= size.y && size.x <= size.z)
    axis.x = 1.0;
  else if (size.y <= size.z)
    axis.y = 1.0;
  else
    axis.z = 1.0;
  return unit_of(glm::cross(unit, axis));
}

/// The rotation of a quaternion that need not be of length 1, but has one.
inline glm::dmat3 rotation_of(const glm::quat& rotation) {
  glm::dquat q(rotation.w, rotation.x, rotation.y, rotation.z);
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  CHECK(length > 0.0);
  q = glm::dquat(q.w / length, q.x / length, q.y / length, q.z / length);
  return glm::mat3_cast(q);
}

}  // namespace scree
