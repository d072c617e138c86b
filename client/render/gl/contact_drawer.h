// Darkens what loose pieces lie on (client/render/scene/contact.h), by the depths of the picture so far.
// Needs the GL context current.
#pragma once

#include <span>

#include "client/render/gl/depth_copy.h"
#include "client/render/gl/gl.h"
#include "client/render/scene/contact.h"
#include "shared/base/result.h"

namespace scree {

class ContactDrawer {
 public:
  /// Fails when a shader does.
  static Result<ContactDrawer> create();

  /// `depths`: of all that was drawn. One command, but none without contacts.
  void draw(std::span<const Contact> contacts, const DrawPass& pass, const DepthCopy& depths);

 private:
  explicit ContactDrawer(gl::Program&& program);

  gl::Program program_;
  gl::VertexArray array_;
  gl::Buffer contacts_;
};

}  // namespace scree
