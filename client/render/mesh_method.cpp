#include "client/render/mesh_method.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "client/render/gl.h"
#include "client/render/gpu_mesh.h"
#include "client/render/mesh_scheduler.h"
#include "client/render/piece_tint.h"
#include "client/render/shader_sources.h"

namespace scree {
namespace {

glm::vec3 as_vector(VoxelCoord v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// The uniforms of surface.vert that differ from mesh to mesh, looked up once.
struct SurfaceProgram {
  gl::Program program;
  GLint step_m, origin_m, centre_m, place_m, rotation, loose, tint;

  explicit SurfaceProgram(gl::Program&& linked)
      : program(std::move(linked)),
        step_m(program.uniform("u_step_m")),
        origin_m(program.uniform("u_origin_m")),
        centre_m(program.uniform("u_centre_m")),
        place_m(program.uniform("u_place_m")),
        rotation(program.uniform("u_rotation")),
        loose(program.uniform("u_loose")),
        tint(program.uniform("u_tint")) {}
};

Result<SurfaceProgram> link_surface() {
  const std::array vertex{shader_source("rotation.glsl"), shader_source("surface.vert")};
  const std::array fragment{shader_source("rotation.glsl"), shader_source("atmosphere.glsl"),
                            shader_source("noise.glsl"),    shader_source("rock.glsl"),
                            shader_source("shadow.glsl"),   shader_source("surface.frag")};
  Result<gl::Program> program = gl::Program::link("surface", vertex, fragment);
  if (!program) return fail(program.error().message);
  return SurfaceProgram(std::move(*program));
}

Result<SurfaceProgram> link_shadow() {
  const std::array vertex{shader_source("rotation.glsl"), shader_source("surface.vert")};
  Result<gl::Program> program =
      gl::Program::link("surface_shadow", vertex, std::array{shader_source("surface_shadow.frag")});
  if (!program) return fail(program.error().message);
  return SurfaceProgram(std::move(*program));
}

struct PieceView {
  std::optional<GpuMesh> mesh;  ///< none: too small for the grid
  glm::vec3 centre_m;
  float radius_m;
  Pose pose;  ///< the last known: a piece that has merged stays there until the rock is shown
};

class MeshMethod final : public DrawMethod {
 public:
  MeshMethod(WorkPool& pool, float view_radius_m, Polygoniser polygoniser, SurfaceProgram&& surface,
             SurfaceProgram&& shadow)
      : polygoniser_(polygoniser),
        scheduler_(pool, view_radius_m, polygoniser),
        surface_(std::move(surface)),
        shadow_(std::move(shadow)) {}

  std::string_view name() const override { return polygoniser_ == Polygoniser::nets ? "mesh" : "dual"; }
  void changed(const MirrorChanges& changes) override { scheduler_.changed(changes); }
  bool loaded() const override { return scheduler_.loaded(); }
  bool complete() const override { return scheduler_.complete(); }
  void update(const Scene& scene, const Camera& camera) override;
  float reach_m() const override { return scheduler_.reach_m(); }
  void draw(const DrawPass& pass) override;
  DrawStats stats() const override;

 private:
  void show(MeshUpdate&& update);
  void erase(const SurfaceNode& node);
  void show_piece(const PieceMesh& piece);
  void draw_terrain(const SurfaceProgram& program, const Frustum& frustum, glm::vec3 eye_m);
  void draw_pieces(const SurfaceProgram& program, const Frustum& frustum);
  void count(const GpuMesh& mesh);

  Polygoniser polygoniser_;
  MeshScheduler scheduler_;
  SurfaceProgram surface_;
  SurfaceProgram shadow_;
  float voxel_m_ = 0.0F;
  /// A node's mesh, in voxels of its own level.
  struct Block {
    GpuMesh mesh;
    float voxel_m;
  };
  std::unordered_map<SurfaceNode, Block, SurfaceNodeHash> blocks_;
  std::unordered_map<PieceId, PieceView> pieces_;
  std::vector<std::pair<float, const Block*>> visible_;  ///< squared distance; kept for its memory
  size_t gpu_bytes_ = 0;
  DrawStats pass_;
};

void MeshMethod::update(const Scene& scene, const Camera& camera) {
  voxel_m_ = scene.field.source().voxel_size_m;
  show(scheduler_.update(scene, camera.eye_m));
  for (auto& [id, view] : pieces_) {
    const auto piece = scene.pieces.find(id);
    if (piece != scene.pieces.end()) view.pose = piece->second.pose;
  }
}

void MeshMethod::show(MeshUpdate&& update) {
  for (const SurfaceNode& node : update.gone) erase(node);
  for (const NodeMesh& node : update.nodes) {
    erase(node.node);
    if (node.mesh.empty()) continue;
    const float voxel_m = voxel_m_ * static_cast<float>(1 << node.level);
    gpu_bytes_ += blocks_.emplace(node.node, Block{GpuMesh(node.mesh), voxel_m}).first->second.mesh.bytes();
  }
  for (const PieceId id : update.removed_pieces) {
    const auto found = pieces_.find(id);
    if (found == pieces_.end()) continue;
    if (found->second.mesh) gpu_bytes_ -= found->second.mesh->bytes();
    pieces_.erase(found);
  }
  for (const PieceMesh& piece : update.pieces) show_piece(piece);
}

void MeshMethod::erase(const SurfaceNode& node) {
  const auto found = blocks_.find(node);
  if (found == blocks_.end()) return;
  gpu_bytes_ -= found->second.mesh.bytes();
  blocks_.erase(found);
}

void MeshMethod::show_piece(const PieceMesh& piece) {
  PieceView view;
  if (!piece.mesh.empty()) {
    view.mesh.emplace(piece.mesh);
    gpu_bytes_ += view.mesh->bytes();
  }
  view.pose = piece.piece.pose;
  view.centre_m = piece.piece.volume->centre_voxels * voxel_m_;
  const VoxelBox& box = piece.piece.volume->window.box;
  view.radius_m = glm::length(as_vector(box.size())) * voxel_m_;
  pieces_.insert_or_assign(piece.id, std::move(view));
}

void MeshMethod::draw(const DrawPass& pass) {
  const bool shadow = pass.kind == DrawPass::Kind::shadow;
  const SurfaceProgram& program = shadow ? shadow_ : surface_;
  program.program.use();
  program.program.set("u_view_projection", pass.view_projection);
  if (!shadow) {
    program.program.set("u_eye", pass.eye_m);
    program.program.set("u_sun", pass.lighting.sun);
    program.program.set("u_fog_m", pass.lighting.fog_m);
    program.program.set("u_ice_above_m", pass.lighting.ice_above_m);
    program.program.set("u_shadow_matrix", pass.lighting.shadow_matrix);
    program.program.set("u_shadow_map", 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, pass.lighting.shadow_map);
  }
  pass_ = {};
  const Frustum frustum(pass.view_projection);
  draw_terrain(program, frustum, pass.eye_m);
  draw_pieces(program, frustum);
  glBindVertexArray(0);
}

void MeshMethod::count(const GpuMesh& mesh) {
  mesh.draw();
  ++pass_.draws;
  pass_.triangles += mesh.triangles();
}

void MeshMethod::draw_terrain(const SurfaceProgram& program, const Frustum& frustum, glm::vec3 eye_m) {
  glUniform3f(program.centre_m, 0.0F, 0.0F, 0.0F);
  glUniform3f(program.place_m, 0.0F, 0.0F, 0.0F);
  glUniform4f(program.rotation, 0.0F, 0.0F, 0.0F, 1.0F);
  glUniform1f(program.loose, 0.0F);
  // Near ones first: what they hide is not shaded.
  visible_.clear();
  for (const auto& [node, block] : blocks_) {
    const float side_m = voxel_m_ * static_cast<float>(block_size << node.level);
    const glm::vec3 centre_m = (glm::vec3(static_cast<float>(node.at.x), static_cast<float>(node.at.y),
                                          static_cast<float>(node.at.z)) +
                                0.5F) *
                               side_m;
    // Polygons reach into the cells about the node.
    if (!frustum.touches(centre_m, side_m * (0.5F + 1.0F / block_size) * 1.7321F)) continue;
    const glm::vec3 away = centre_m - eye_m;
    visible_.emplace_back(glm::dot(away, away), &block);
  }
  std::ranges::sort(visible_);
  for (const auto& [distance, block] : visible_) {
    const glm::vec3 origin_m = as_vector(block->mesh.origin()) * block->voxel_m;
    glUniform3f(program.origin_m, origin_m.x, origin_m.y, origin_m.z);
    glUniform1f(program.step_m, block->voxel_m / surface_steps_per_voxel);
    count(block->mesh);
  }
}

void MeshMethod::draw_pieces(const SurfaceProgram& program, const Frustum& frustum) {
  glUniform1f(program.loose, 1.0F);
  glUniform1f(program.step_m, voxel_m_ / surface_steps_per_voxel);
  for (const auto& [id, view] : pieces_) {
    if (!view.mesh || !frustum.touches(view.pose.position_m, view.radius_m)) continue;
    const glm::vec3 origin_m = as_vector(view.mesh->origin()) * voxel_m_;
    const glm::vec3 place_m = view.pose.position_m;
    const glm::quat& turn = view.pose.rotation;
    glUniform3f(program.origin_m, origin_m.x, origin_m.y, origin_m.z);
    glUniform3f(program.centre_m, view.centre_m.x, view.centre_m.y, view.centre_m.z);
    glUniform3f(program.place_m, place_m.x, place_m.y, place_m.z);
    glUniform4f(program.rotation, turn.x, turn.y, turn.z, turn.w);
    glUniform1f(program.tint, tint_of(id));
    count(*view.mesh);
  }
}

DrawStats MeshMethod::stats() const {
  DrawStats stats = pass_;
  stats.memory = {{"meshes", 0, gpu_bytes_}};
  stats.pieces = pieces_.size();
  stats.waiting = scheduler_.waiting();
  return stats;
}

Result<std::unique_ptr<DrawMethod>> make_method(WorkPool& pool, float view_radius_m,
                                                Polygoniser polygoniser) {
  Result<SurfaceProgram> surface = link_surface();
  if (!surface) return fail(surface.error().message);
  Result<SurfaceProgram> shadow = link_shadow();
  if (!shadow) return fail(shadow.error().message);
  return std::make_unique<MeshMethod>(pool, view_radius_m, polygoniser, std::move(*surface),
                                      std::move(*shadow));
}

}  // namespace

Result<std::unique_ptr<DrawMethod>> make_mesh_method(WorkPool& pool, float view_radius_m) {
  return make_method(pool, view_radius_m, Polygoniser::nets);
}

Result<std::unique_ptr<DrawMethod>> make_dual_method(WorkPool& pool, float view_radius_m) {
  return make_method(pool, view_radius_m, Polygoniser::dual);
}

}  // namespace scree
