#include "client/render/gl/line_drawer.h"

#include <array>
#include <cstddef>

#include "client/render/gl/shader_sources.h"

namespace scree {
namespace {

constexpr float hidden_alpha = 0.22F;

}  // namespace

Result<LineDrawer> LineDrawer::create() {
  Result<gl::Program> program = gl::Program::link("lines", std::array{shader_source("lines.vert")},
                                                  std::array{shader_source("lines.frag")});
  if (!program) return fail(program.error().message);
  return LineDrawer(std::move(*program));
}

LineDrawer::LineDrawer(gl::Program&& program) : program_(std::move(program)) {
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
  const auto stride = static_cast<GLsizei>(sizeof(LineVertex));
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, nullptr);
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride,
                        reinterpret_cast<const void*>(offsetof(LineVertex, colour)));
  glBindVertexArray(0);
}

void LineDrawer::draw(const LineList& lines, const glm::mat4& view_projection) const {
  if (lines.vertices().empty() && lines.corners().empty()) return;
  program_.use();
  program_.set("u_view_projection", view_projection);
  program_.set("u_alpha", 1.0F);
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
  if (upload(lines.corners())) {
    glDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(lines.corners().size()));
    glEnable(GL_CULL_FACE);
  }
  if (upload(lines.vertices())) draw_lines(static_cast<GLsizei>(lines.vertices().size()));
  glBindVertexArray(0);
}

bool LineDrawer::upload(std::span<const LineVertex> vertices) {
  if (vertices.empty()) return false;
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(),
               GL_STREAM_DRAW);
  return true;
}

void LineDrawer::draw_lines(GLsizei count) const {
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  const auto pass = [&](GLenum depth, float alpha) {
    glDepthFunc(depth);
    program_.set("u_alpha", alpha);
    glDrawArrays(GL_LINES, 0, count);
  };
  pass(GL_LEQUAL, 1.0F);
  pass(GL_GREATER, hidden_alpha);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

}  // namespace scree
