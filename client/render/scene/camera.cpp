#include "client/render/scene/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace scree {
namespace {

/// Near enough not to cut into the rock in front of an eye that a wall stops.
constexpr float near_m = 0.1F;
constexpr glm::vec3 up{0.0F, 1.0F, 0.0F};

}  // namespace

glm::vec3 Camera::forward() const {
  return {-std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
}

glm::vec3 Camera::right() const {
  return glm::normalize(glm::cross(forward(), up));
}

glm::mat4 Camera::view() const {
  return glm::lookAt(eye_m, eye_m + forward(), up);
}

glm::mat4 Camera::projection(float aspect, float far_m) const {
  return glm::perspective(field_of_view, aspect, near_m, far_m);
}

Frustum::Frustum(const glm::mat4& view_projection) {
  // Gribb & Hartmann 2001: planes are sums of the matrix's rows.
  const glm::vec4 w = glm::row(view_projection, 3);
  for (int i = 0; i < 3; ++i) {
    planes_[static_cast<size_t>(2 * i)] = w + glm::row(view_projection, i);
    planes_[static_cast<size_t>(2 * i + 1)] = w - glm::row(view_projection, i);
  }
  for (glm::vec4& plane : planes_) plane /= glm::length(glm::vec3(plane));
}

bool Frustum::touches(glm::vec3 centre, float radius) const {
  for (const glm::vec4& plane : planes_)
    if (glm::dot(glm::vec3(plane), centre) + plane.w < -radius) return false;
  return true;
}

}  // namespace scree
