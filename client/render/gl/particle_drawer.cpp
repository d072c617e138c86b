#include "client/render/gl/particle_drawer.h"

#include <array>
#include <cstddef>
#include <glm/matrix.hpp>

#include "client/render/gl/lighting.h"
#include "client/render/gl/shader_sources.h"

namespace scree {
namespace {

/// One attribute of all four corners.
void describe(GLuint index, GLint size, GLenum type, size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, size, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE,
                        static_cast<GLsizei>(sizeof(Particle)), reinterpret_cast<const void*>(offset));
  glVertexAttribDivisor(index, 1);
}

}  // namespace

Result<ParticleDrawer> ParticleDrawer::create() {
  const std::array vertex{shader_source("shadow.glsl"), shader_source("particle.vert")};
  const std::array fragment{shader_source("atmosphere.glsl"), shader_source("noise.glsl"),
                            shader_source("clouds.glsl"), shader_source("haze.glsl"),
                            shader_source("particle.frag")};
  Result<gl::Program> program = gl::Program::link("particle", vertex, fragment);
  if (!program) return fail(program.error().message);
  return ParticleDrawer(std::move(*program));
}

ParticleDrawer::ParticleDrawer(gl::Program&& program) : program_(std::move(program)) {
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, particles_.name());
  describe(0, 3, GL_FLOAT, offsetof(Particle, place_m));
  describe(1, 1, GL_FLOAT, offsetof(Particle, radius_m));
  describe(2, 4, GL_UNSIGNED_BYTE, offsetof(Particle, colour));
  describe(3, 1, GL_FLOAT, offsetof(Particle, turn));
  describe(4, 1, GL_FLOAT, offsetof(Particle, slender));
  glBindVertexArray(0);
}

void ParticleDrawer::draw(std::span<const Particle> particles, const DrawPass& pass) const {
  if (particles.empty()) return;
  program_.use();
  program_.set("u_view_projection", pass.view_projection);
  set_lighting(program_, pass, 0);
  // Across and upwards in the picture: rows of the view's rotation, as long as the projection makes them.
  const glm::mat4 across = glm::transpose(pass.view_projection);
  program_.set("u_right", glm::normalize(glm::vec3(across[0])));
  program_.set("u_up", glm::normalize(glm::vec3(across[1])));
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, particles_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(particles.size_bytes()), particles.data(),
               GL_STREAM_DRAW);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glDisable(GL_CULL_FACE);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(particles.size()));
  glEnable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glBindVertexArray(0);
}

}  // namespace scree
