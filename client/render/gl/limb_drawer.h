// Draws the bodies of persons by instances: one draw for all limbs, lit as models of props are, into depth
// and the shadow map. Needs the GL context current.
#pragma once

#include <span>

#include "client/render/gl/gl.h"
#include "client/render/scene/draw_method.h"
#include "client/render/scene/limb.h"

namespace scree {

class LimbDrawer {
 public:
  /// Fails when a shader does.
  static Result<LimbDrawer> create();

  void draw(std::span<const Limb> limbs, const DrawPass& pass) const;

 private:
  LimbDrawer(gl::Program&& colour, gl::Program&& shadow);

  gl::Program colour_, shadow_;
  gl::VertexArray array_;
  gl::Buffer vertices_, corners_, limbs_;
  GLsizei corner_count_ = 0;
};

}  // namespace scree
