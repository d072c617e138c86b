#include "client/render/gl/contact_drawer.h"

#include <array>
#include <glm/matrix.hpp>

#include "client/render/gl/shader_sources.h"

namespace scree {
namespace {

/// Corners of a cube as one strip of triangles.
constexpr GLsizei strip_corners = 14;

}  // namespace

Result<ContactDrawer> ContactDrawer::create() {
  Result<gl::Program> program = gl::Program::link("contact", std::array{shader_source("contact.vert")},
                                                  std::array{shader_source("contact.frag")});
  if (!program) return fail(program.error().message);
  return ContactDrawer(std::move(*program));
}

ContactDrawer::ContactDrawer(gl::Program&& program) : program_(std::move(program)) {
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, contacts_.name());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(sizeof(Contact)), nullptr);
  glVertexAttribDivisor(0, 1);
  glBindVertexArray(0);
}

void ContactDrawer::draw(std::span<const Contact> contacts, const DrawPass& pass, const DepthCopy& depths) {
  if (contacts.empty()) return;
  program_.use();
  program_.set("u_view_projection", pass.view_projection);
  program_.set("u_inverse_view_projection", glm::inverse(pass.view_projection));
  program_.set("u_eye", pass.eye_m);
  program_.set("u_depth", 0);
  depths.bind(0);
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, contacts_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(contacts.size_bytes()), contacts.data(),
               GL_STREAM_DRAW);
  // The far sides of the boxes, without a test: they are there, too, when the eye is within.
  glEnable(GL_BLEND);
  glBlendFunc(GL_ZERO, GL_SRC_COLOR);
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glCullFace(GL_FRONT);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, strip_corners, static_cast<GLsizei>(contacts.size()));
  glCullFace(GL_BACK);
  glDepthMask(GL_TRUE);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glBindVertexArray(0);
}

}  // namespace scree
