// Draws a LineList into a picture and its depths, triangles first: hidden parts of lines are drawn faintly.
// Within OpenGL ES 3.0's subset. Needs the GL context current, the destructor too.
#pragma once

#include "client/render/gl/gl.h"
#include "client/render/scene/line_list.h"

namespace scree {

class LineDrawer {
 public:
  static Result<LineDrawer> create();

  /// Into the framebuffer that is bound.
  void draw(const LineList& lines, const glm::mat4& view_projection) const;

 private:
  explicit LineDrawer(gl::Program&& program);
  /// Into the buffer that is bound; whether there is anything.
  static bool upload(std::span<const LineVertex> vertices);
  void draw_lines(GLsizei count) const;

  gl::Program program_;
  gl::VertexArray array_;
  gl::Buffer vertices_;
};

}  // namespace scree
