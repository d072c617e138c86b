#include "client/render/meshing/mesh_scheduler.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <utility>

#include "client/render/scene/limits.h"

namespace scree {
namespace {

/// Side of a node of level 0, metres.
float block_m(const TerrainSource& source) {
  return source.voxel_size_m * static_cast<float>(block_size);
}

/// All of the finest level within half the view radius, or within four blocks if that is more.
float fine_m(const TerrainSource& source, float view_radius_m) {
  return std::max(0.5F * view_radius_m, 4.0F * block_m(source));
}

}  // namespace

struct MeshScheduler::Inbox {
  struct Generated {
    LevelChunk at;
    GeneratedChunk chunk;
  };

  std::mutex mutex;
  std::vector<Generated> generated;
  std::vector<NodeMesh> nodes;
  std::vector<PieceMesh> pieces;
};

struct MeshScheduler::Batch {
  std::vector<SurfaceNode> nodes;       ///< to be meshed
  std::set<LevelChunk> terrain_needed;  ///< before they can be
  bool begun = false;                   ///< the meshes
  size_t jobs_left = 0;
  bool of_changes = false;
  MeshUpdate update;

  bool waits_for_terrain() const { return !begun && !terrain_needed.empty(); }
};

MeshScheduler::MeshScheduler(WorkPool& pool, float view_radius_m, Polygoniser polygoniser, FaceEdges edges)
    : pool_(pool),
      view_radius_m_(view_radius_m),
      polygoniser_(polygoniser),
      edges_(edges),
      inbox_(std::make_shared<Inbox>()) {}

MeshScheduler::~MeshScheduler() = default;

float MeshScheduler::reach_m() const {
  return view_radius_m_ * limits::horizon_per_view_radius;
}

size_t MeshScheduler::waiting() const {
  return collected_.bricks.size() + collected_.pieces_added.size() + collected_.pieces_removed.size() +
         (batch_ ? batch_->nodes.size() + 1 : 0) + (grown_ ? 0 : 1);
}

void MeshScheduler::changed(const MirrorChanges& changes) {
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(collected_.bricks, changes.bricks);
  append(collected_.pieces_added, changes.pieces_added);
  append(collected_.pieces_removed, changes.pieces_removed);
}

void MeshScheduler::start(const TerrainSource& source) {
  // As many levels as reach the horizon with nodes no wider than a quarter of the way.
  int levels = 1;
  while (levels < limits::mesh_levels_max &&
         fine_m(source, view_radius_m_) * static_cast<float>(1 << (levels - 1)) < reach_m())
    ++levels;
  levels_.emplace(source, levels);
  forest_.emplace(ForestShape{levels, block_m(source), fine_m(source, view_radius_m_), reach_m(),
                              floor_m(source), std::max(limits::terrain_top_m, top_m(source))});
}

MeshUpdate MeshScheduler::update(const Scene& scene, glm::vec3 eye_m) {
  if (!forest_) start(scene.field.source());
  collect_results(scene.field);
  MeshUpdate update;
  if (batch_ && batch_->begun && batch_->jobs_left == 0) {
    caught_up_ = caught_up_ || batch_->of_changes;
    growth_is_due_ = batch_->of_changes;
    update = std::move(batch_->update);
    batch_.reset();
  }
  if (batch_ && batch_->waits_for_terrain() && !batch_->of_changes && has_changes()) give_way();
  if (!batch_) begin_batch(scene, eye_m);
  if (batch_ && batch_->waits_for_terrain()) generate_needed();
  if (batch_ && !batch_->begun && batch_->terrain_needed.empty()) begin_meshes(scene.field);
  return update;
}

void MeshScheduler::collect_results(const Field& field) {
  Inbox done;
  {
    const std::lock_guard lock(inbox_->mutex);
    std::swap(done.generated, inbox_->generated);
    std::swap(done.nodes, inbox_->nodes);
    std::swap(done.pieces, inbox_->pieces);
  }
  for (Inbox::Generated& generated : done.generated) {
    levels_->adopt_generated(field, generated.at.level, generated.at.chunk, std::move(generated.chunk));
    generating_.erase(generated.at);
    if (batch_) batch_->terrain_needed.erase(generated.at);
  }
  if (!batch_) return;
  batch_->jobs_left -= done.nodes.size() + done.pieces.size();
  std::ranges::move(done.nodes, std::back_inserter(batch_->update.nodes));
  std::ranges::move(done.pieces, std::back_inserter(batch_->update.pieces));
}

bool MeshScheduler::has_changes() const {
  return !collected_.bricks.empty() || !collected_.pieces_added.empty() || !collected_.pieces_removed.empty();
}

void MeshScheduler::begin_batch(const Scene& scene, glm::vec3 eye_m) {
  if (!has_changes()) caught_up_ = true;
  if (!has_changes() || growth_is_due_) {
    begin_growth(scene.field, eye_m);
    if (!has_changes() || (batch_ && !batch_->waits_for_terrain())) return;
    if (batch_) give_way();
  }
  begin_changes(scene);
}

/// No batch if there is nothing to grow.
void MeshScheduler::begin_growth(const Field& field, glm::vec3 eye_m) {
  growth_is_due_ = false;
  ForestStep step = forest_->grow(eye_m, limits::forest_steps_max);
  grown_ = step.empty();
  if (grown_) return;
  batch_ = std::make_unique<Batch>();
  batch_->nodes = std::move(step.changed);
  batch_->update.gone = std::move(step.gone);
  ask_for_terrain(field);
}

/// Undoes the forest's growth; the terrain that is being generated for it will be ready when it grows again.
void MeshScheduler::give_way() {
  forest_->undo();
  batch_.reset();
}

/// Begins a batch of the mirror's changes.
void MeshScheduler::begin_changes(const Scene& scene) {
  batch_ = std::make_unique<Batch>();
  batch_->of_changes = true;
  std::unordered_set<SurfaceNode, SurfaceNodeHash> dirty;
  for (const BrickCoord brick : collected_.bricks) {
    const VoxelCoord first = first_voxel(brick);
    for (const SurfaceNode& node : forest_->leaves_around(
             {first, first + VoxelCoord{brick_size, brick_size, brick_size}}, surface_nets_apron + 1))
      dirty.insert(node);
  }
  batch_->nodes.assign(dirty.begin(), dirty.end());
  batch_->update.removed_pieces = std::move(collected_.pieces_removed);
  for (const PieceId id : collected_.pieces_added) {
    const auto piece = scene.pieces.find(id);
    if (piece == scene.pieces.end()) continue;  // gone again before it was ever shown
    ++batch_->jobs_left;
    submit_piece(scene.field, id, piece->second);
  }
  collected_ = {};
  ask_for_terrain(scene.field);
}

/// The chunks into which the nodes' windows reach are generated first, on the pool.
void MeshScheduler::ask_for_terrain(const Field& field) {
  const auto need = [&](int level, const VoxelBox& box) {
    for_each_chunk(box.grown(surface_nets_apron), [&](ChunkCoord chunk) {
      if (!levels_->has_generated(field, level, chunk)) batch_->terrain_needed.insert({level, chunk});
    });
  };
  for (const SurfaceNode& node : batch_->nodes) {
    need(node.level, samples_of(node));
    const Neighbours& around = forest_->neighbours(node);
    if (std::ranges::find(around, Neighbour::finer) == around.end()) continue;
    const VoxelBox box = samples_of(node);
    const auto twice = [](VoxelCoord v) { return VoxelCoord{v.x * 2, v.y * 2, v.z * 2}; };
    need(node.level - 1, VoxelBox{twice(box.lo), twice(box.hi)}.grown(surface_nets_apron));
  }
  generate_needed();
}

/// As far as the ground is here; the others later.
void MeshScheduler::generate_needed() {
  for (const LevelChunk& at : batch_->terrain_needed) {
    if (generating_.contains(at) || !is_here(levels_->source(at.level), at.chunk)) continue;
    generating_.insert(at);
    pool_.submit(WorkPool::Urgency::load, [inbox = inbox_, source = levels_->source(at.level), at] {
      GeneratedChunk generated = generate_chunk(source, at.chunk);
      const std::lock_guard lock(inbox->mutex);
      inbox->generated.push_back({at, std::move(generated)});
    });
  }
}

void MeshScheduler::begin_meshes(const Field& field) {
  batch_->begun = true;
  for (const SurfaceNode& node : batch_->nodes) {
    std::optional<NodeJob> job =
        gather_node(*levels_, field, node, forest_->neighbours(node), polygoniser_, edges_);
    if (!job) {
      batch_->update.nodes.push_back({node, node.level, {}});
      continue;
    }
    ++batch_->jobs_left;
    pool_.submit(WorkPool::Urgency::edit, [inbox = inbox_, job = std::move(*job)] {
      NodeMesh done = mesh_node(job);
      const std::lock_guard lock(inbox->mutex);
      inbox->nodes.push_back(std::move(done));
    });
  }
}

void MeshScheduler::submit_piece(const Field& field, PieceId id, const ScenePiece& piece) {
  pool_.submit(WorkPool::Urgency::edit, [inbox = inbox_, job = gather_piece(field, id, piece)] {
    PieceMesh done = mesh_piece(job);
    const std::lock_guard lock(inbox->mutex);
    inbox->pieces.push_back(std::move(done));
  });
}

}  // namespace scree
