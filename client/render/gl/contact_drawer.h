// Darkens what loose pieces lie on (client/render/scene/contact.h), by the depths of the picture so far.
// Needs the GL context current.
#pragma once

#include <span>

#include "client/render/gl/gl.h"
#include "client/render/scene/contact.h"
#include "shared/base/result.h"

namespace scree {

class ContactDrawer {
 public:
  /// Fails when a shader does.
  static Result<ContactDrawer> create();

  /// Into a canvas (canvas.h) of that size: its depths, averaged if it has many samples, are copied first.
  /// Two commands, but none without contacts.
  void draw(std::span<const Contact> contacts, const DrawPass& pass, unsigned framebuffer, int width,
            int height);

 private:
  explicit ContactDrawer(gl::Program&& program);
  void copy_depths(unsigned framebuffer, int width, int height);

  gl::Program program_;
  gl::VertexArray array_;
  gl::Buffer contacts_;
  gl::Texture depth_;
  gl::Framebuffer copy_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace scree
