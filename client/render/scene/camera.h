// The viewer's camera. Metres, radians; y is up. Yaw 0 looks along −z, 90° along −x: it grows to the
// left. Pitch grows upwards.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace scree {

struct Camera {
  glm::vec3 eye_m{0.0F};
  float yaw = 0.0F;
  float pitch = 0.0F;
  float field_of_view = 1.05F;  ///< vertical

  glm::vec3 forward() const;
  glm::vec3 right() const;
  glm::mat4 view() const;
  /// `far_m`: nothing beyond is drawn. `aspect` = width / height.
  glm::mat4 projection(float aspect, float far_m) const;
};

/// The six planes of a view volume, to skip objects outside.
class Frustum {
 public:
  explicit Frustum(const glm::mat4& view_projection);
  /// False only if the sphere is entirely outside.
  bool touches(glm::vec3 centre, float radius) const;

 private:
  std::array<glm::vec4, 6> planes_;
};

}  // namespace scree
