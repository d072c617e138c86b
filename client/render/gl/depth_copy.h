// The depths of a picture so far as a texture, for what is drawn over it by them. Needs the GL context
// current.
#pragma once

#include "client/render/gl/gl.h"

namespace scree {

class DepthCopy {
 public:
  /// Takes those of a canvas (canvas.h) of that size: averaged if it has many samples. Leaves it bound.
  void take(unsigned framebuffer, int width, int height);
  void bind(unsigned unit) const;

 private:
  gl::Texture depth_;
  gl::Framebuffer copy_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace scree
