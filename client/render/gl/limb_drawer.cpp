#include "client/render/gl/limb_drawer.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "client/render/gl/lighting.h"
#include "client/render/gl/shader_sources.h"
#include "client/render/gl/surface_variants.h"

namespace scree {
namespace {

/// Sides about a limb, and rings of a half from its middle to its end.
constexpr int limb_sides = 10, limb_rings = 3;

struct LimbMesh {
  std::vector<glm::vec4> points;  ///< on the ball of radius 1; w: the half, −1 or 1
  std::vector<uint16_t> corners;
};

/// Both halves have a ring of their own at the middle; between these lies what a long limb has.
LimbMesh limb_mesh() {
  constexpr float pi = std::numbers::pi_v<float>;
  LimbMesh mesh;
  for (int row = 0; row < 2 * (limb_rings + 1); ++row) {
    const int step = row <= limb_rings ? row - limb_rings : row - limb_rings - 1;
    const float up = 0.5F * pi * static_cast<float>(step) / limb_rings;
    for (int side = 0; side < limb_sides; ++side) {
      const float angle = 2.0F * pi * static_cast<float>(side) / limb_sides;
      mesh.points.emplace_back(std::cos(up) * std::cos(angle), std::sin(up), std::cos(up) * std::sin(angle),
                               row <= limb_rings ? -1.0F : 1.0F);
    }
  }
  for (int row = 0; row + 1 < 2 * (limb_rings + 1); ++row)
    for (int side = 0; side < limb_sides; ++side) {
      const int next = (side + 1) % limb_sides, low = row * limb_sides, high = low + limb_sides;
      for (const int corner : {low + side, high + side, high + next, low + side, high + next, low + next})
        mesh.corners.push_back(static_cast<uint16_t>(corner));
    }
  return mesh;
}

void describe_limb(GLuint index, GLint size, GLenum type, size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, size, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE,
                        static_cast<GLsizei>(sizeof(Limb)), reinterpret_cast<const void*>(offset));
  glVertexAttribDivisor(index, 1);
}

}  // namespace

Result<LimbDrawer> LimbDrawer::create() {
  const std::array vertex{shader_source("rotation.glsl"), shader_source("limb.vert")};
  const std::array fragment{
      define_of(Surfaces::ground),  shader_source("rotation.glsl"), shader_source("atmosphere.glsl"),
      shader_source("noise.glsl"),  shader_source("clouds.glsl"),   shader_source("haze.glsl"),
      shader_source("stones.glsl"), shader_source("material.glsl"), shader_source("rock.glsl"),
      shader_source("shadow.glsl"), shader_source("limb.frag")};
  Result<gl::Program> colour = gl::Program::link("limb", vertex, fragment);
  if (!colour) return fail(colour.error().message);
  Result<gl::Program> shadow =
      gl::Program::link("limb_shadow", vertex, std::array{shader_source("surface_shadow.frag")});
  if (!shadow) return fail(shadow.error().message);
  return LimbDrawer(std::move(*colour), std::move(*shadow));
}

LimbDrawer::LimbDrawer(gl::Program&& colour, gl::Program&& shadow)
    : colour_(std::move(colour)), shadow_(std::move(shadow)) {
  const LimbMesh mesh = limb_mesh();
  corner_count_ = static_cast<GLsizei>(mesh.corners.size());
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.points.size() * sizeof(glm::vec4)),
               mesh.points.data(), GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(sizeof(glm::vec4)), nullptr);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, corners_.name());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.corners.size() * sizeof(uint16_t)),
               mesh.corners.data(), GL_STATIC_DRAW);
  glBindBuffer(GL_ARRAY_BUFFER, limbs_.name());
  describe_limb(1, 4, GL_FLOAT, offsetof(Limb, middle_m));
  describe_limb(2, 4, GL_FLOAT, offsetof(Limb, rotation));
  describe_limb(3, 3, GL_FLOAT, offsetof(Limb, radius_m));
  describe_limb(4, 4, GL_UNSIGNED_BYTE, offsetof(Limb, colour));
  glBindVertexArray(0);
}

void LimbDrawer::draw(std::span<const Limb> limbs, const DrawPass& pass) const {
  if (limbs.empty()) return;
  const bool is_shadow = pass.kind == DrawPass::Kind::shadow;
  const gl::Program& program = is_shadow ? shadow_ : colour_;
  program.use();
  program.set("u_view_projection", pass.view_projection);
  if (!is_shadow) set_lighting(program, pass, 0);
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, limbs_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(limbs.size_bytes()), limbs.data(), GL_STREAM_DRAW);
  glDrawElementsInstanced(GL_TRIANGLES, corner_count_, GL_UNSIGNED_SHORT, nullptr,
                          static_cast<GLsizei>(limbs.size()));
  glBindVertexArray(0);
}

}  // namespace scree
