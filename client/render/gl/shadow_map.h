// Depths along the sun's direction, in one square around the camera's view. Needs the GL context current.
#pragma once

#include <glm/mat4x4.hpp>

#include "client/render/gl/gl.h"
#include "client/render/scene/camera.h"

namespace scree {

class ShadowMap {
 public:
  /// `side`: texels.
  explicit ShadowMap(int side);

  /// From now on draws go into the map; returns the sun's view and projection.
  glm::mat4 begin(const Camera& camera, glm::vec3 sun, float view_radius_m);
  void end() const;

  /// From the world to the map's coordinates, 0..1.
  const glm::mat4& matrix() const { return matrix_; }
  unsigned texture() const { return depth_.name(); }

 private:
  int side_;
  gl::Texture depth_;
  gl::Framebuffer framebuffer_;
  glm::mat4 matrix_{1.0F};
};

}  // namespace scree
