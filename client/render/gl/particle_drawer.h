// Draws particles (client/render/scene/particle.h) over what is there, behind what is nearer. Needs the GL
// context current.
#pragma once

#include <span>

#include "client/render/gl/gl.h"
#include "client/render/scene/draw_method.h"
#include "client/render/scene/particle.h"
#include "shared/base/result.h"

namespace scree {

class ParticleDrawer {
 public:
  /// Fails when a shader does.
  static Result<ParticleDrawer> create();

  /// One draw; nothing without particles. They are blended in their order: the farthest should come first.
  /// Depths are tested, and stay.
  void draw(std::span<const Particle> particles, const DrawPass& pass) const;

 private:
  explicit ParticleDrawer(gl::Program&& program);

  gl::Program program_;
  gl::VertexArray array_;
  gl::Buffer particles_;
};

}  // namespace scree
