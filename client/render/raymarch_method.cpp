#include "client/render/raymarch_method.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <utility>

#include "client/render/brick_world.h"
#include "client/render/gl.h"
#include "client/render/march_targets.h"
#include "client/render/shader_sources.h"

namespace scree {
namespace {

struct Programs {
  gl::Program cone;
  gl::Program march;
  gl::Program composite;
};

Result<Programs> link_programs() {
  const std::array ray{shader_source("raymarch.vert")};
  const std::array cone{shader_source("bricks.glsl"), shader_source("march.glsl"),
                        shader_source("raymarch_cone.frag")};
  Result<gl::Program> cones = gl::Program::link("raymarch_cone", ray, cone);
  if (!cones) return fail(cones.error().message);
  const std::array pixel{shader_source("bricks.glsl"),     shader_source("march.glsl"),
                         shader_source("atmosphere.glsl"), shader_source("noise.glsl"),
                         shader_source("rock.glsl"),       shader_source("raymarch.frag")};
  Result<gl::Program> pixels = gl::Program::link("raymarch", ray, pixel);
  if (!pixels) return fail(pixels.error().message);
  Result<gl::Program> composite = gl::Program::link("composite", std::array{shader_source("screen.vert")},
                                                    std::array{shader_source("composite.frag")});
  if (!composite) return fail(composite.error().message);
  return Programs{std::move(*cones), std::move(*pixels), std::move(*composite)};
}

/// Radius that a pixel covers at one metre: half of what lies between two rays.
float pixel_at_one_metre(const glm::mat4& inverse, int height) {
  const auto ray = [&](float y) {
    const glm::vec4 far = inverse * glm::vec4(0.0F, y, 1.0F, 1.0F);
    const glm::vec4 near = inverse * glm::vec4(0.0F, y, -1.0F, 1.0F);
    return glm::normalize(glm::vec3(far) / far.w - glm::vec3(near) / near.w);
  };
  return glm::length(ray(1.0F / static_cast<float>(height)) - ray(-1.0F / static_cast<float>(height)));
}

class RaymarchMethod final : public DrawMethod {
 public:
  RaymarchMethod(WorkPool& pool, float view_radius_m, Programs&& programs)
      : pool_(pool), view_radius_m_(view_radius_m), programs_(std::move(programs)) {}

  std::string_view name() const override { return "raymarch"; }
  void changed(const MirrorChanges& changes) override {
    bricks_.insert(bricks_.end(), changes.bricks.begin(), changes.bricks.end());
  }
  void update(const Scene& scene, const Camera& camera) override;
  bool loaded() const override { return world_ && world_->loaded(); }
  bool complete() const override { return loaded() && bricks_.empty(); }
  void draw(const DrawPass& pass) override;
  DrawStats stats() const override;

 private:
  void draw_cones(const DrawPass& pass, const glm::mat4& inverse, float pixel);
  void draw_pixels(const DrawPass& pass, const glm::mat4& inverse, float pixel);
  void composite(glm::ivec2 size);

  WorkPool& pool_;
  float view_radius_m_;
  Programs programs_;
  MarchTargets targets_;
  gl::VertexArray nothing_;  ///< core profiles draw with an array bound only
  std::optional<BrickWorld> world_;
  std::vector<BrickCoord> bricks_;  ///< changed since the last update
};

void RaymarchMethod::update(const Scene& scene, const Camera& camera) {
  if (!world_) world_.emplace(pool_, scene.field.source(), view_radius_m_);
  world_->update(scene.field, bricks_, camera.eye_m);
  bricks_.clear();
}

void RaymarchMethod::draw(const DrawPass& pass) {
  if (pass.kind == DrawPass::Kind::shadow || !world_) return;
  GLint framebuffer = 0;
  std::array<GLint, 4> viewport{};
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  glGetIntegerv(GL_VIEWPORT, viewport.data());
  const glm::ivec2 size(viewport[2], viewport[3]);
  targets_.resize(size);
  const glm::mat4 inverse = glm::inverse(pass.view_projection);
  const float pixel = pixel_at_one_metre(inverse, targets_.size().y);
  glBindVertexArray(nothing_.name());
  draw_cones(pass, inverse, pixel);
  draw_pixels(pass, inverse, pixel);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(framebuffer));
  glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
  composite(size);
}

void RaymarchMethod::draw_cones(const DrawPass& pass, const glm::mat4& inverse, float pixel) {
  const gl::Program& program = programs_.cone;
  program.use();
  world_->use(program, pass.eye_m);
  program.set("u_inverse_view_projection", inverse);
  program.set("u_eye", pass.eye_m);
  const glm::vec2 span = glm::vec2(targets_.tiles() * MarchTargets::tile) / glm::vec2(targets_.size());
  glUniform2f(program.uniform("u_span"), span.x, span.y);
  // To a tile's corner, and a little more.
  program.set("u_cone", pixel * static_cast<float>(MarchTargets::tile) * 0.5F * 1.5F);
  targets_.draw_tiles();
  glDisable(GL_DEPTH_TEST);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEnable(GL_DEPTH_TEST);
}

void RaymarchMethod::draw_pixels(const DrawPass& pass, const glm::mat4& inverse, float pixel) {
  const gl::Program& program = programs_.march;
  program.use();
  world_->use(program, pass.eye_m);
  program.set("u_inverse_view_projection", inverse);
  program.set("u_view_projection", pass.view_projection);
  program.set("u_eye", pass.eye_m);
  program.set("u_sun", pass.lighting.sun);
  program.set("u_fog_m", pass.lighting.fog_m);
  program.set("u_pixel", pixel);
  program.set("u_tile", MarchTargets::tile);
  program.set("u_tiles", 2);
  glUniform2f(program.uniform("u_span"), 1.0F, 1.0F);
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_2D, targets_.tile_texture());
  glActiveTexture(GL_TEXTURE0);
  targets_.draw_pixels();
  glDepthFunc(GL_ALWAYS);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_LESS);
}

void RaymarchMethod::composite(glm::ivec2 size) {
  const gl::Program& program = programs_.composite;
  program.use();
  program.set("u_colour", 0);
  program.set("u_depth", 1);
  glUniform2f(program.uniform("u_texel"), 1.0F / static_cast<float>(size.x),
              1.0F / static_cast<float>(size.y));
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, targets_.depth_texture());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, targets_.colour_texture());
  glDepthFunc(GL_ALWAYS);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_LESS);
}

DrawStats RaymarchMethod::stats() const {
  DrawStats stats;
  stats.draws = 3;
  stats.triangles = 3;
  stats.gpu_bytes = targets_.bytes() + (world_ ? world_->gpu_bytes() : 0);
  stats.waiting = bricks_.size() + (world_ ? world_->waiting() : 0);
  return stats;
}

}  // namespace

Result<std::unique_ptr<DrawMethod>> make_raymarch_method(WorkPool& pool, float view_radius_m) {
  Result<Programs> programs = link_programs();
  if (!programs) return fail(programs.error().message);
  return std::make_unique<RaymarchMethod>(pool, view_radius_m, std::move(*programs));
}

}  // namespace scree
