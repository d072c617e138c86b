// Draws water as a level (shared/base/water.h): one triangle over the picture so far, by its depths. Writes
// no depth. Needs the GL context current.
#pragma once

#include <optional>

#include "client/render/gl/depth_copy.h"
#include "client/render/gl/gl.h"
#include "client/render/scene/draw_method.h"
#include "shared/base/result.h"
#include "shared/base/water.h"

namespace scree {

class WaterDrawer {
 public:
  /// The first level links the shader; fails when it does not.
  Result<void> set_level(WaterLevel level_m);
  WaterLevel level_m() const { return level_m_; }

  /// After the sky. `depths`: of all that was drawn.
  void draw(const DepthCopy& depths, const DrawPass& pass) const;

 private:
  WaterLevel level_m_;
  std::optional<gl::Program> program_;
  gl::VertexArray nothing_;  ///< core profiles draw with an array bound only
};

}  // namespace scree
