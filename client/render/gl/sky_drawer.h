// Draws the sky with its clouds wherever nothing else was drawn. Needs the GL context current.
#pragma once

#include "client/render/gl/gl.h"
#include "client/render/scene/draw_method.h"
#include "shared/base/result.h"

namespace scree {

class SkyDrawer {
 public:
  /// Fails when a shader does.
  static Result<SkyDrawer> create();

  void draw(const DrawPass& pass) const;

 private:
  explicit SkyDrawer(gl::Program&& program) : program_(std::move(program)) {}

  gl::Program program_;
  gl::VertexArray nothing_;  ///< core profiles draw with an array bound only
};

}  // namespace scree
