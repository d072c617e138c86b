#include "client/render/mesh/mesh_method.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>
#include <vector>

#include "client/render/gl/lighting.h"
#include "client/render/gl/mesh_arena.h"
#include "client/render/levels/surface_looks.h"
#include "client/render/meshing/mesh_scheduler.h"
#include "client/render/pieces/piece_views.h"
#include "client/render/scene/limits.h"

namespace scree {
namespace {

/// Samples along a side of a group of blocks of one level, which are one draw. Positions within it, and those
/// of blocks that reach beyond it, fit 16 bits.
constexpr int group_side = 128;

/// A group's origin, in samples of its level.
struct BlockGroup {
  int level = 0;
  VoxelCoord origin;
  bool is_ground = true;  ///< without materials and heaps

  bool operator==(const BlockGroup&) const = default;
};

/// Whether the shader for mere ground draws it.
bool is_ground(const SurfaceMesh& mesh) {
  return std::ranges::all_of(mesh.vertices, [](const SurfaceVertex& vertex) {
    return vertex.look == 0 && unpacked_come(vertex.before) == 0;
  });
}

BlockGroup group_of(const NodeMesh& mesh) {
  const auto down = [](int v) { return v & ~(group_side - 1); };
  const VoxelCoord at = mesh.mesh.origin;
  return {mesh.level, {down(at.x), down(at.y), down(at.z)}, is_ground(mesh.mesh)};
}

struct BlockGroupHash {
  size_t operator()(const BlockGroup& group) const {
    return CoordHash()(group.origin) * 31 + static_cast<size_t>(group.level) * 2 + (group.is_ground ? 1 : 0);
  }
};

class MeshMethod final : public DrawMethod {
 public:
  MeshMethod(WorkPool& pool, float view_radius_m, Polygoniser polygoniser, FaceEdges edges,
             SurfaceVariants<SurfaceProgram>&& surface, SurfaceProgram&& shadow)
      : scheduler_(pool, view_radius_m, polygoniser, edges),
        surface_(std::move(surface)),
        shadow_(std::move(shadow)) {}

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
  const SurfaceProgram& use(const DrawPass& pass, bool ground);
  void draw_terrain(const SurfaceProgram& program, bool ground, bool all);
  void find_visible(const Frustum& frustum, glm::vec3 eye_m);

  MeshScheduler scheduler_;
  SurfaceVariants<SurfaceProgram> surface_;
  SurfaceProgram shadow_;
  float voxel_m_ = 0.0F;
  struct Block {
    MeshArena::Slot slot;
    BlockGroup group;
  };
  /// What is in sight of a group; its memory is kept from frame to frame.
  struct Batch {
    BlockGroup group;
    std::vector<MeshArena::Slot> slots;
  };
  MeshArena arena_;
  std::unordered_map<SurfaceNode, Block, SurfaceNodeHash> blocks_;
  PieceViews pieces_;
  std::vector<std::pair<float, const Block*>> visible_;  ///< squared distance
  std::unordered_map<BlockGroup, size_t, BlockGroupHash> batch_of_;
  std::vector<Batch> batches_;  ///< the first batch_of_.size() of them are this pass's, near ones first
  DrawStats pass_;
};

void MeshMethod::update(const Scene& scene, const Camera& camera) {
  voxel_m_ = scene.field.source().voxel_size_m;
  show(scheduler_.update(scene, camera.eye_m));
  // A merged piece stays at its last pose until the rock is shown.
  pieces_.move(scene.pieces);
}

void MeshMethod::show(MeshUpdate&& update) {
  for (const SurfaceNode& node : update.gone) erase(node);
  for (const NodeMesh& node : update.nodes) {
    erase(node.node);
    if (node.mesh.empty()) continue;
    const BlockGroup group = group_of(node);
    blocks_.emplace(node.node, Block{arena_.add(node.mesh, group.origin), group});
  }
  for (const PieceId id : update.removed_pieces) pieces_.remove(id);
  for (const PieceMesh& piece : update.pieces) pieces_.show(piece, voxel_m_);
}

void MeshMethod::erase(const SurfaceNode& node) {
  const auto found = blocks_.find(node);
  if (found == blocks_.end()) return;
  arena_.remove(found->second.slot);
  blocks_.erase(found);
}

void MeshMethod::draw(const DrawPass& pass) {
  const bool shadow = pass.kind == DrawPass::Kind::shadow;
  pass_ = {};
  find_visible(Frustum(pass.view_projection), pass.eye_m);
  if (!shadow) draw_terrain(use(pass, true), true, false);
  const SurfaceProgram& program = use(pass, false);
  draw_terrain(program, false, shadow);
  // Last, for the ground hides most of a stone that merged: small triangles cost the most to shade.
  pieces_.draw(program, pass, voxel_m_, pass_);
  glBindVertexArray(0);
}

/// The program of a pass, for mere ground or for all.
const SurfaceProgram& MeshMethod::use(const DrawPass& pass, bool ground) {
  const bool shadow = pass.kind == DrawPass::Kind::shadow;
  const SurfaceProgram& program = shadow ? shadow_ : surface_.of(surfaces(ground, pass));
  program.program.use();
  program.program.set("u_view_projection", pass.view_projection);
  if (!shadow) set_lighting(program.program, pass, 0);
  program.program.set("u_lift", shadow ? 0.0F : limits::stone_lift_voxels * voxel_m_);
  return program;
}

/// The groups in sight that are mere ground, or those that are not, or all.
void MeshMethod::draw_terrain(const SurfaceProgram& program, bool ground, bool all) {
  glUniform1f(program.loose, 0.0F);
  glUniform1f(program.voxel_m, voxel_m_);
  for (size_t i = 0; i < batch_of_.size(); ++i) {
    const Batch& batch = batches_[i];
    if (!all && batch.group.is_ground != ground) continue;
    program.set_place(place_of(batch.group.origin, batch.group.level));
    pass_.draws += arena_.draw(batch.slots);
    for (const MeshArena::Slot& slot : batch.slots) pass_.triangles += slot.triangles();
  }
}

/// Near groups first, and in them near blocks: surfaces behind them are not shaded.
void MeshMethod::find_visible(const Frustum& frustum, glm::vec3 eye_m) {
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
  batch_of_.clear();
  for (const auto& [distance, block] : visible_) {
    const auto [found, is_new] = batch_of_.try_emplace(block->group, batch_of_.size());
    if (is_new) {
      if (batches_.size() < batch_of_.size()) batches_.emplace_back();
      batches_[found->second].group = block->group;
      batches_[found->second].slots.clear();
    }
    batches_[found->second].slots.push_back(block->slot);
  }
}

DrawStats MeshMethod::stats() const {
  DrawStats stats = pass_;
  stats.memory = {{"meshes", 0, arena_.bytes() + pieces_.gpu_bytes()}};
  stats.pieces = pieces_.count();
  stats.resident = blocks_.size();
  stats.waiting = scheduler_.waiting();
  return stats;
}

Result<std::unique_ptr<DrawMethod>> make_method(WorkPool& pool, float view_radius_m, Polygoniser polygoniser,
                                                FaceEdges edges = FaceEdges::sharp) {
  auto surface = SurfaceVariants<SurfaceProgram>::make(link_surface);
  if (!surface) return fail(surface.error().message);
  Result<SurfaceProgram> shadow = link_surface_shadow();
  if (!shadow) return fail(shadow.error().message);
  return std::make_unique<MeshMethod>(pool, view_radius_m, polygoniser, edges, std::move(*surface),
                                      std::move(*shadow));
}

}  // namespace

Result<std::unique_ptr<DrawMethod>> make_mesh_method(WorkPool& pool, float view_radius_m) {
  return make_method(pool, view_radius_m, Polygoniser::nets);
}

Result<std::unique_ptr<DrawMethod>> make_rounded_mesh_method(WorkPool& pool, float view_radius_m) {
  return make_method(pool, view_radius_m, Polygoniser::nets, FaceEdges::rounded);
}

Result<std::unique_ptr<DrawMethod>> make_dual_method(WorkPool& pool, float view_radius_m) {
  return make_method(pool, view_radius_m, Polygoniser::dual);
}

Result<std::unique_ptr<DrawMethod>> make_cubes_method(WorkPool& pool, float view_radius_m) {
  return make_method(pool, view_radius_m, Polygoniser::cubes);
}

}  // namespace scree
