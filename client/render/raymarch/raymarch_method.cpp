#include "client/render/raymarch/raymarch_method.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "client/render/bricks/brick_world.h"
#include "client/render/gl/gl.h"
#include "client/render/gl/gpu_timers.h"
#include "client/render/gl/lighting.h"
#include "client/render/gl/shader_sources.h"
#include "client/render/gl/surface_variants.h"
#include "client/render/pieces/piece_views.h"
#include "client/render/raymarch/march_targets.h"
#include "client/render/scene/limits.h"

namespace scree {
namespace {

/// Texture units: 0 and 1 are BrickWorld's, 2 the tiles', the rays' ends or the pieces' places.
constexpr int raymarch_shadow_unit = 3;
constexpr int places_unit = 4;

struct RaymarchPrograms {
  gl::Program cone;
  gl::Program march;
  SurfaceVariants<gl::Program> shade;
  SurfaceProgram piece;
  SurfaceVariants<gl::Program> shade_pieces;  ///< where some are in sight
  SurfaceProgram piece_shadow;
  gl::Program composite;
};

std::string_view define_of(FaceEdges edges) {
  return edges == FaceEdges::sharp ? "#define EDGES 1\n" : "";
}

/// Links a program of shaders/ files that covers the screen.
Result<gl::Program> link(std::string_view name, std::string_view vertex,
                         std::initializer_list<std::string_view> fragment, FaceEdges edges) {
  std::vector<std::string_view> parts{define_of(edges)};
  for (const std::string_view file : fragment) parts.push_back(shader_source(file));
  return gl::Program::link(name, std::array{shader_source(vertex)}, parts);
}

template <FaceEdges edges, bool pieces>
Result<gl::Program> link_shade(Surfaces surfaces) {
  std::vector<std::string_view> parts{define_of(surfaces), define_of(edges),
                                      pieces ? "#define PIECES 1\n" : ""};
  for (const std::string_view file :
       {"pieces.glsl", "rotation.glsl", "bricks.glsl", "march.glsl", "atmosphere.glsl", "noise.glsl",
        "clouds.glsl", "haze.glsl", "stones.glsl", "material.glsl", "rock.glsl", "shadow.glsl",
        "raymarch_shade.frag"})
    parts.push_back(shader_source(file));
  return gl::Program::link("raymarch_shade", std::array{shader_source("raymarch.vert")}, parts);
}

template <FaceEdges edges>
Result<RaymarchPrograms> link_raymarch_programs() {
  Result<gl::Program> cone =
      link("raymarch_cone", "raymarch.vert", {"bricks.glsl", "march.glsl", "raymarch_cone.frag"}, edges);
  if (!cone) return fail(cone.error().message);
  Result<gl::Program> march =
      link("raymarch", "raymarch.vert", {"bricks.glsl", "march.glsl", "raymarch.frag"}, edges);
  if (!march) return fail(march.error().message);
  auto shade = SurfaceVariants<gl::Program>::make(link_shade<edges, false>);
  if (!shade) return fail(shade.error().message);
  Result<SurfaceProgram> piece =
      link_surface_program("piece", std::array{shader_source("shape.glsl"), shader_source("piece.frag")});
  if (!piece) return fail(piece.error().message);
  auto shade_pieces = SurfaceVariants<gl::Program>::make(link_shade<edges, true>);
  if (!shade_pieces) return fail(shade_pieces.error().message);
  Result<SurfaceProgram> piece_shadow = link_surface_shadow();
  if (!piece_shadow) return fail(piece_shadow.error().message);
  Result<gl::Program> composite = link("composite", "screen.vert", {"composite.frag"}, edges);
  if (!composite) return fail(composite.error().message);
  return RaymarchPrograms{std::move(*cone),     std::move(*march),        std::move(*shade),
                          std::move(*piece),    std::move(*shade_pieces), std::move(*piece_shadow),
                          std::move(*composite)};
}

/// Radius that a pixel covers at one metre: half the distance between two rays.
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
  RaymarchMethod(WorkPool& pool, float view_radius_m, FaceEdges edges, RaymarchPrograms&& programs)
      : pool_(pool), view_radius_m_(view_radius_m), edges_(edges), programs_(std::move(programs)) {}

  void changed(const MirrorChanges& changes) override {
    bricks_.insert(bricks_.end(), changes.bricks.begin(), changes.bricks.end());
  }
  void update(const Scene& scene, const Camera& camera) override;
  bool loaded() const override { return world_ && world_->loaded(); }
  bool complete() const override { return loaded() && bricks_.empty(); }
  float reach_m() const override { return world_ ? world_->reach_m() : view_radius_m_; }
  void draw(const DrawPass& pass) override;
  DrawStats stats() const override;

 private:
  void draw_cones(const DrawPass& pass, const glm::mat4& inverse, float pixel);
  void march(const DrawPass& pass, const glm::mat4& inverse, float pixel);
  void draw_pieces(const DrawPass& pass);
  void shade(const DrawPass& pass, const glm::mat4& inverse);
  void composite(glm::ivec2 size);
  void cover_screen() const {
    glBindVertexArray(nothing_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

  WorkPool& pool_;
  float view_radius_m_;
  FaceEdges edges_;
  RaymarchPrograms programs_;
  MarchTargets targets_;
  gl::VertexArray nothing_;  ///< core profiles draw with an array bound only
  std::optional<BrickWorld> world_;
  PieceViews pieces_;
  DrawStats pass_;                  ///< of the pieces
  std::vector<BrickCoord> bricks_;  ///< changed since the last update
};

void RaymarchMethod::update(const Scene& scene, const Camera& camera) {
  if (!world_) world_.emplace(pool_, scene.field.source(), view_radius_m_, edges_);
  world_->update(scene.field, bricks_, camera.eye_m);
  bricks_.clear();
  // At once, like the terrain: a piece is never seen beside the rock that it was or has become.
  pieces_.show_all(scene.field, scene.pieces);
}

void RaymarchMethod::draw(const DrawPass& pass) {
  if (!world_) return;
  pass_ = {};
  if (pass.kind == DrawPass::Kind::shadow) return draw_pieces(pass);
  GLint framebuffer = 0;
  std::array<GLint, 4> viewport{};
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  glGetIntegerv(GL_VIEWPORT, viewport.data());
  const glm::ivec2 size(viewport[2], viewport[3]);
  const glm::vec2 marched = glm::vec2(size) * pass.render_scale + 0.5F;
  targets_.resize(glm::max(glm::ivec2(marched), glm::ivec2(1)));
  const glm::mat4 inverse = glm::inverse(pass.view_projection);
  const float pixel = pixel_at_one_metre(inverse, targets_.size().y);
  draw_cones(pass, inverse, pixel);
  draw_pieces(pass);
  march(pass, inverse, pixel);
  shade(pass, inverse);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(framebuffer));
  glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
  composite(size);
}

void RaymarchMethod::draw_cones(const DrawPass& pass, const glm::mat4& inverse, float pixel) {
  const GpuTimers::Part part(pass.timers, "cones");
  const gl::Program& program = programs_.cone;
  program.use();
  world_->use(program, pass.eye_m);
  program.set("u_inverse_view_projection", inverse);
  program.set("u_eye", pass.eye_m);
  const glm::vec2 span = glm::vec2(targets_.tiles() * MarchTargets::tile) / glm::vec2(targets_.size());
  glUniform2f(program.uniform("u_span"), span.x, span.y);
  // To a tile's corner, and a little more.
  program.set("u_cone", pixel * static_cast<float>(MarchTargets::tile) * 0.5F * 1.5F);
  program.set("u_pixel", pixel);
  targets_.draw_tiles();
  glDisable(GL_DEPTH_TEST);
  cover_screen();
  glEnable(GL_DEPTH_TEST);
}

void RaymarchMethod::march(const DrawPass& pass, const glm::mat4& inverse, float pixel) {
  const GpuTimers::Part part(pass.timers, "march");
  const gl::Program& program = programs_.march;
  program.use();
  world_->use(program, pass.eye_m);
  program.set("u_inverse_view_projection", inverse);
  program.set("u_eye", pass.eye_m);
  program.set("u_pixel", pixel);
  program.set("u_tile", MarchTargets::tile);
  program.set("u_are_pieces", pass_.draws > 0 ? 1 : 0);
  program.set("u_tiles", 2);
  program.set("u_pieces_depth", 3);
  glUniform2f(program.uniform("u_span"), 1.0F, 1.0F);
  glActiveTexture(GL_TEXTURE3);
  glBindTexture(GL_TEXTURE_2D, targets_.depth_texture());
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_2D, targets_.tile_texture());
  glActiveTexture(GL_TEXTURE0);
  targets_.draw_hits();
  cover_screen();
}

void RaymarchMethod::draw_pieces(const DrawPass& pass) {
  const GpuTimers::Part part(pass.timers, "pieces");
  const bool shadow = pass.kind == DrawPass::Kind::shadow;
  if (!shadow) {
    targets_.draw_pieces();
    const std::array<GLuint, 4> nothing_met{};
    glClearBufferuiv(GL_COLOR, 0, nothing_met.data());
    glClear(GL_DEPTH_BUFFER_BIT);
  }
  if (pieces_.count() == 0) return;
  const SurfaceProgram& surface = shadow ? programs_.piece_shadow : programs_.piece;
  surface.program.use();
  surface.program.set("u_view_projection", pass.view_projection);
  surface.program.set("u_eye", pass.eye_m);
  surface.program.set("u_lift", shadow ? 0.0F : limits::stone_lift_voxels * world_->voxel_m());
  pieces_.draw(surface, pass, world_->voxel_m(), pass_);
}

void RaymarchMethod::shade(const DrawPass& pass, const glm::mat4& inverse) {
  const GpuTimers::Part part(pass.timers, "shade");
  const gl::Program& program = pass_.draws > 0 ? programs_.shade_pieces.of(surfaces(false, pass))
                                               : programs_.shade.of(surfaces(world_->is_untouched(), pass));
  program.use();
  world_->use(program, pass.eye_m);
  program.set("u_inverse_view_projection", inverse);
  program.set("u_view_projection", pass.view_projection);
  glUniform2f(program.uniform("u_span"), 1.0F, 1.0F);
  set_lighting(program, pass, raymarch_shadow_unit);
  const bool bodies = pieces_.count() > 0 || pass.lighting.props_cast;
  program.set("u_bodies", bodies ? 1 : 0);
  if (!bodies) program.set("u_shadow_samples", 0);
  program.set("u_lift", limits::stone_lift_voxels * world_->voxel_m());
  program.set("u_hits", 2);
  program.set("u_pieces", places_unit);
  glActiveTexture(GL_TEXTURE0 + places_unit);
  glBindTexture(GL_TEXTURE_2D, pieces_.places_texture());
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_2D, targets_.hits_texture());
  glActiveTexture(GL_TEXTURE0);
  targets_.draw_pixels();
  glDepthFunc(GL_ALWAYS);
  cover_screen();
  glDepthFunc(GL_LESS);
}

void RaymarchMethod::composite(glm::ivec2 size) {
  const gl::Program& program = programs_.composite;
  program.use();
  program.set("u_colour", 0);
  program.set("u_depth", 1);
  glUniform2f(program.uniform("u_texel"), 1.0F / static_cast<float>(size.x),
              1.0F / static_cast<float>(size.y));
  const glm::vec2 source = 1.0F / glm::vec2(targets_.size());
  glUniform2f(program.uniform("u_source"), source.x, source.y);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, targets_.depth_texture());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, targets_.colour_texture());
  glDepthFunc(GL_ALWAYS);
  cover_screen();
  glDepthFunc(GL_LESS);
}

DrawStats RaymarchMethod::stats() const {
  DrawStats stats;
  stats.draws = 4 + pass_.draws;
  stats.triangles = 4 + pass_.triangles;
  stats.pieces = pieces_.count();
  if (world_) {
    stats.memory = world_->memory();
    stats.resident = world_->atlas().bricks();
  }
  stats.memory.push_back({"targets", 0, targets_.bytes()});
  stats.memory.push_back({"pieces", 0, pieces_.gpu_bytes()});
  stats.waiting = bricks_.size() + (world_ ? world_->waiting() : 0);
  return stats;
}

template <FaceEdges edges>
Result<std::unique_ptr<DrawMethod>> make_method(WorkPool& pool, float view_radius_m) {
  Result<RaymarchPrograms> programs = link_raymarch_programs<edges>();
  if (!programs) return fail(programs.error().message);
  return std::make_unique<RaymarchMethod>(pool, view_radius_m, edges, std::move(*programs));
}

}  // namespace

Result<std::unique_ptr<DrawMethod>> make_raymarch_method(WorkPool& pool, float view_radius_m) {
  return make_method<FaceEdges::sharp>(pool, view_radius_m);
}

Result<std::unique_ptr<DrawMethod>> make_rounded_raymarch_method(WorkPool& pool, float view_radius_m) {
  return make_method<FaceEdges::rounded>(pool, view_radius_m);
}

}  // namespace scree
