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

void ContactDrawer::copy_depths(unsigned framebuffer, int width, int height) {
  if (width != width_ || height != height_) {
    width_ = width;
    height_ = height;
    glBindTexture(GL_TEXTURE_2D, depth_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, width, height, 0, GL_DEPTH_COMPONENT,
                 GL_UNSIGNED_INT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, copy_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
    const GLenum none = GL_NONE;
    glDrawBuffers(1, &none);
    glReadBuffer(GL_NONE);
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, copy_.name());
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

void ContactDrawer::draw(std::span<const Contact> contacts, const DrawPass& pass, unsigned framebuffer,
                         int width, int height) {
  if (contacts.empty()) return;
  copy_depths(framebuffer, width, height);
  program_.use();
  program_.set("u_view_projection", pass.view_projection);
  program_.set("u_inverse_view_projection", glm::inverse(pass.view_projection));
  program_.set("u_eye", pass.eye_m);
  program_.set("u_depth", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, depth_.name());
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
