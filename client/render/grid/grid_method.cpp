#include "client/render/grid/grid_method.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "client/render/bricks/brick_world.h"
#include "client/render/gl/gpu_timers.h"
#include "client/render/gl/lighting.h"
#include "client/render/gl/shader_sources.h"
#include "client/render/grid/grid_points.h"
#include "client/render/pieces/piece_views.h"
#include "client/render/scene/limits.h"
#include "shared/surface/cube_cases.h"
#include "shared/surface/surface_cells.h"

namespace scree {
namespace {

/// Texture units: 0 and 1 are BrickWorld's.
constexpr int lines_unit = 2;
constexpr int grid_shadow_unit = 3;
constexpr int cases_unit = 4;

/// As client/shaders/grid.geom reads it: for each case a row of corners of triangles, and one that ends it.
constexpr size_t case_row = 3 * cube_triangles_max + 1;
constexpr uint8_t no_corner = 255;

std::vector<uint8_t> case_texels() {
  std::vector<uint8_t> texels;
  for (const CubeCase& cube : cube_cases()) {
    std::array<uint8_t, case_row> row;
    row.fill(no_corner);
    for (size_t i = 0; i < 3 * size_t{cube.triangles}; ++i) {
      const int axis = cube.edges[i] / 4;
      row[i] = static_cast<uint8_t>(cell_tables().edges[cube.edges[i]].from | axis << 3);
    }
    texels.insert(texels.end(), row.begin(), row.end());
  }
  return texels;
}

Result<gl::Program> link_grid(std::string_view name, std::span<const std::string_view> fragment) {
  const std::array vertex{shader_source("grid.vert")};
  const std::array geometry{shader_source("bricks.glsl"), shader_source("march.glsl"),
                            shader_source("grid.geom")};
  return gl::Program::link(name, vertex, fragment, geometry);
}

Result<gl::Program> link_terrain(Surfaces surfaces) {
  return link_grid("grid", surface_fragment_parts(surfaces));
}

struct GridPrograms {
  SurfaceVariants<gl::Program> grid;
  gl::Program grid_shadow;
  SurfaceVariants<SurfaceProgram> piece;
  SurfaceProgram piece_shadow;
};

Result<GridPrograms> link_grid_programs() {
  auto grid = SurfaceVariants<gl::Program>::make(link_terrain);
  if (!grid) return fail(grid.error().message);
  Result<gl::Program> shadow = link_grid("grid_shadow", std::array{shader_source("surface_shadow.frag")});
  if (!shadow) return fail(shadow.error().message);
  auto piece = SurfaceVariants<SurfaceProgram>::make(link_surface);
  if (!piece) return fail(piece.error().message);
  Result<SurfaceProgram> piece_shadow = link_surface_shadow();
  if (!piece_shadow) return fail(piece_shadow.error().message);
  return GridPrograms{std::move(*grid), std::move(*shadow), std::move(*piece), std::move(*piece_shadow)};
}

class GridMethod final : public DrawMethod {
 public:
  GridMethod(WorkPool& pool, float view_radius_m, GridPrograms&& programs);

  void changed(const MirrorChanges& changes) override {
    bricks_.insert(bricks_.end(), changes.bricks.begin(), changes.bricks.end());
  }
  void update(const Scene& scene, const Camera& camera) override;
  bool loaded() const override { return world_ && world_->loaded(); }
  bool complete() const override { return loaded() && bricks_.empty(); }
  float reach_m() const override;
  void set_options(const DrawOptionValues& values) override { shape_ = grid_shape_of(values); }
  void draw(const DrawPass& pass) override;
  DrawStats stats() const override;

 private:
  void draw_terrain(const DrawPass& pass, const Frustum& frustum);
  void draw_pieces(const DrawPass& pass);
  size_t terrain_triangles() const;

  WorkPool& pool_;
  float view_radius_m_;
  GridPrograms programs_;
  GridShape shape_;
  gl::Texture cases_;
  gl::Query triangles_;  ///< of the terrain in the last colour pass
  bool counted_ = false;
  mutable GLuint known_triangles_ = 0;
  GridPoints points_;
  std::optional<BrickWorld> world_;
  PieceViews pieces_;
  std::vector<BrickCoord> bricks_;  ///< changed since the last update
  DrawStats pass_;
};

GridMethod::GridMethod(WorkPool& pool, float view_radius_m, GridPrograms&& programs)
    : pool_(pool), view_radius_m_(view_radius_m), programs_(std::move(programs)) {
  glBindTexture(GL_TEXTURE_2D, cases_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8UI, case_row, static_cast<GLsizei>(cube_cases().size()), 0,
               GL_RED_INTEGER, GL_UNSIGNED_BYTE, case_texels().data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void GridMethod::update(const Scene& scene, const Camera& camera) {
  if (!world_) world_.emplace(pool_, scene.field.source(), view_radius_m_, FaceEdges::rounded);
  world_->update(scene.field, bricks_, camera.eye_m);
  bricks_.clear();
  // At once, like the terrain: a piece is never seen beside the rock that it was or has become.
  pieces_.show_all(scene.field, scene.pieces);
}

float GridMethod::reach_m() const {
  if (!world_) return view_radius_m_;
  return std::min(static_cast<float>(grid_reach(shape_)) * world_->voxel_m(), world_->reach_m());
}

void GridMethod::draw(const DrawPass& pass) {
  if (!world_) return;
  pass_ = {};
  draw_terrain(pass, Frustum(pass.view_projection));
  draw_pieces(pass);
}

void GridMethod::draw_terrain(const DrawPass& pass, const Frustum& frustum) {
  const GpuTimers::Part part(pass.timers, "grid");
  const bool shadow = pass.kind == DrawPass::Kind::shadow;
  const gl::Program& program =
      shadow ? programs_.grid_shadow : programs_.grid.of(surfaces(world_->is_untouched(), pass));
  points_.place(shape_, *world_, pass.eye_m, frustum);
  program.use();
  world_->use(program, pass.eye_m);
  set_lighting(program, pass, grid_shadow_unit);
  program.set("u_view_projection", pass.view_projection);
  program.set("u_loose", 0.0F);
  program.set("u_lines", lines_unit);
  program.set("u_cases", cases_unit);
  glActiveTexture(GL_TEXTURE0 + lines_unit);
  glBindTexture(GL_TEXTURE_2D, points_.line_texture());
  glActiveTexture(GL_TEXTURE0 + cases_unit);
  glBindTexture(GL_TEXTURE_2D, cases_.name());
  glActiveTexture(GL_TEXTURE0);
  if (shadow) return points_.draw();
  glBeginQuery(GL_PRIMITIVES_GENERATED, triangles_.name());
  points_.draw();
  glEndQuery(GL_PRIMITIVES_GENERATED);
  counted_ = true;
  ++pass_.draws;
}

void GridMethod::draw_pieces(const DrawPass& pass) {
  const bool shadow = pass.kind == DrawPass::Kind::shadow;
  const SurfaceProgram& program = shadow ? programs_.piece_shadow : programs_.piece.of(surfaces(false, pass));
  program.program.use();
  program.program.set("u_view_projection", pass.view_projection);
  if (!shadow) set_lighting(program.program, pass, grid_shadow_unit);
  program.program.set("u_lift", shadow ? 0.0F : limits::stone_lift_voxels * world_->voxel_m());
  pieces_.draw(program, pass, world_->voxel_m(), pass_);
  glBindVertexArray(0);
}

/// Triangles of the last frame that the GPU has reported: no thread waits for it.
size_t GridMethod::terrain_triangles() const {
  GLuint ready = GL_FALSE;
  if (counted_) glGetQueryObjectuiv(triangles_.name(), GL_QUERY_RESULT_AVAILABLE, &ready);
  if (ready == GL_TRUE) glGetQueryObjectuiv(triangles_.name(), GL_QUERY_RESULT, &known_triangles_);
  return known_triangles_;
}

DrawStats GridMethod::stats() const {
  DrawStats stats = pass_;
  stats.triangles += terrain_triangles();
  stats.pieces = pieces_.count();
  if (world_) {
    stats.memory = world_->memory();
    stats.resident = world_->atlas().bricks();
  }
  stats.memory.push_back({"grid", 0, points_.gpu_bytes() + case_row * cube_cases().size()});
  stats.memory.push_back({"pieces", 0, pieces_.gpu_bytes()});
  stats.waiting = bricks_.size() + (world_ ? world_->waiting() : 0);
  return stats;
}

}  // namespace

std::optional<std::string> grid_method_missing() {
  if (epoxy_is_desktop_gl() && epoxy_gl_version() >= 32) return std::nullopt;
  return "geometry shaders, which OpenGL 3.2 has and OpenGL ES 3.0 has not";
}

Result<std::unique_ptr<DrawMethod>> make_grid_method(WorkPool& pool, float view_radius_m) {
  Result<GridPrograms> programs = link_grid_programs();
  if (!programs) return fail(programs.error().message);
  return std::make_unique<GridMethod>(pool, view_radius_m, std::move(*programs));
}

}  // namespace scree
