#include "client/render/mesh_scheduler.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "client/render/block_windows.h"
#include "client/render/limits.h"

namespace scree {
namespace {

constexpr int blocks_per_chunk = chunk_size / block_size;

ChunkCoord chunk_of(BlockCoord block) {
  return {block.x >> 1, block.y >> 1, block.z >> 1};
}
static_assert(blocks_per_chunk == 2);

/// Blocks whose windows reach into the brick.
void add_blocks_around(BrickCoord brick, std::unordered_set<BlockCoord, CoordHash>& blocks) {
  const VoxelCoord first = first_voxel(brick);
  const auto low = [](int v) { return (v - surface_nets_apron) >> 4; };
  const auto high = [](int v) { return (v + brick_size - 1 + surface_nets_apron) >> 4; };
  for (int x = low(first.x); x <= high(first.x); ++x)
    for (int y = low(first.y); y <= high(first.y); ++y)
      for (int z = low(first.z); z <= high(first.z); ++z) blocks.insert({x, y, z});
}
static_assert(block_size == 16);

/// Squared distance of a chunk's centre from a point, metres.
float squared_distance(ChunkCoord chunk, glm::vec3 eye_m, float chunk_m) {
  const glm::vec3 centre = (glm::vec3(chunk.x, chunk.y, chunk.z) + 0.5F) * chunk_m;
  const glm::vec3 d = centre - eye_m;
  return d.x * d.x + d.y * d.y + d.z * d.z;
}

/// Calls f(ChunkCoord) for the chunk and the 26 around it, into which its blocks' windows reach.
template <typename F>
void for_each_around(ChunkCoord chunk, F&& f) {
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) f(chunk + ChunkCoord{x, y, z});
}

}  // namespace

/// What a worker needs to mesh one block.
struct MeshScheduler::BlockJob {
  BlockCoord block;
  uint64_t gathered = 0;
  std::optional<BlockWindows> windows;  ///< nothing: the block has no surface
};

struct MeshScheduler::Inbox {
  struct Blocks {
    std::vector<BlockMesh> meshes;
    std::optional<ChunkCoord> loaded;  ///< of a batch, if none
  };
  struct Generated {
    ChunkCoord coord;
    GeneratedChunk chunk;
  };

  std::mutex mutex;
  std::vector<Generated> generated;
  std::vector<Blocks> blocks;
  std::vector<PieceMesh> pieces;
};

struct MeshScheduler::Batch {
  size_t jobs_left = 0;
  MeshUpdate update;
};

MeshScheduler::MeshScheduler(WorkPool& pool, float view_radius_m)
    : pool_(pool), view_radius_m_(view_radius_m), inbox_(std::make_shared<Inbox>()) {}

MeshScheduler::~MeshScheduler() = default;

size_t MeshScheduler::waiting() const {
  return pending_.size() + loading_ + collected_.bricks.size() + collected_.pieces_added.size() +
         collected_.pieces_removed.size() + (batch_ ? 1 : 0);
}

void MeshScheduler::changed(const MirrorChanges& changes) {
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(collected_.bricks, changes.bricks);
  append(collected_.pieces_added, changes.pieces_added);
  append(collected_.pieces_removed, changes.pieces_removed);
}

MeshUpdate MeshScheduler::update(const Scene& scene, glm::vec3 eye_m) {
  MeshUpdate update;
  follow(scene.field.source(), eye_m, update);
  take_results(scene.field, update);
  if (!batch_) begin_batch(scene);
  if (!batch_) caught_up_ = true;
  begin_loads(scene.field);
  return update;
}

void MeshScheduler::show(BlockMesh&& mesh, MeshUpdate& update) {
  if (!chunks_.contains(chunk_of(mesh.block))) return;
  uint64_t& shown = shown_[mesh.block];
  if (mesh.gathered < shown) return;
  shown = mesh.gathered;
  update.blocks.push_back(std::move(mesh));
}

void MeshScheduler::take_results(Field& field, MeshUpdate& update) {
  Inbox done;
  {
    const std::lock_guard lock(inbox_->mutex);
    std::swap(done.generated, inbox_->generated);
    std::swap(done.blocks, inbox_->blocks);
    std::swap(done.pieces, inbox_->pieces);
  }
  for (Inbox::Generated& generated : done.generated)
    take_generated(field, generated.coord, std::move(generated.chunk));
  for (Inbox::Blocks& blocks : done.blocks) {
    if (blocks.loaded) {
      --loading_;
      const auto chunk = chunks_.find(*blocks.loaded);
      if (chunk == chunks_.end()) continue;
      chunk->second = ChunkState::loaded;
      for (BlockMesh& mesh : blocks.meshes) show(std::move(mesh), update);
      continue;
    }
    --batch_->jobs_left;
    for (BlockMesh& mesh : blocks.meshes) batch_->update.blocks.push_back(std::move(mesh));
  }
  for (PieceMesh& piece : done.pieces) {
    --batch_->jobs_left;
    batch_->update.pieces.push_back(std::move(piece));
  }
  if (!batch_ || batch_->jobs_left > 0) return;
  for (BlockMesh& mesh : batch_->update.blocks) show(std::move(mesh), update);
  update.pieces = std::move(batch_->update.pieces);
  update.removed_pieces = std::move(batch_->update.removed_pieces);
  batch_.reset();
}

void MeshScheduler::follow(const TerrainSource& source, glm::vec3 eye_m, MeshUpdate& update) {
  const float chunk_m = source.voxel_size_m * static_cast<float>(chunk_size);
  const auto whole = [chunk_m](float v) { return static_cast<int>(std::floor(v / chunk_m)); };
  const ChunkCoord centre{whole(eye_m.x), whole(eye_m.y), whole(eye_m.z)};
  if (started_ && centre == centre_) return;
  started_ = true;
  centre_ = centre;
  const float keep_m = view_radius_m_ * limits::view_radius_keep + chunk_m;
  std::erase_if(chunks_, [&](const auto& entry) {
    const bool far = squared_distance(entry.first, eye_m, chunk_m) > keep_m * keep_m;
    if (far) update.dropped_chunks.push_back(entry.first);
    return far;
  });
  std::erase_if(uniform_, [&](const auto& entry) {
    return squared_distance(entry.first, eye_m, chunk_m) > (keep_m + 2 * chunk_m) * (keep_m + 2 * chunk_m);
  });
  std::erase_if(shown_, [&](const auto& entry) { return !chunks_.contains(chunk_of(entry.first)); });

  pending_.clear();
  const int reach = static_cast<int>(std::ceil(view_radius_m_ / chunk_m));
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z) {
        const ChunkCoord chunk = centre + ChunkCoord{x, y, z};
        const bool near = squared_distance(chunk, eye_m, chunk_m) <= view_radius_m_ * view_radius_m_;
        if (near && !chunks_.contains(chunk)) pending_.push_back(chunk);
      }
  std::ranges::sort(pending_, std::greater<>{},
                    [&](ChunkCoord chunk) { return squared_distance(chunk, eye_m, chunk_m); });
}

void MeshScheduler::begin_batch(const Scene& scene) {
  if (collected_.bricks.empty() && collected_.pieces_added.empty() && collected_.pieces_removed.empty())
    return;
  batch_ = std::make_unique<Batch>();
  std::unordered_set<BlockCoord, CoordHash> dirty;
  for (const BrickCoord brick : collected_.bricks) add_blocks_around(brick, dirty);
  for (const BlockCoord block : dirty) {
    if (!chunks_.contains(chunk_of(block))) continue;
    std::vector<BlockJob> jobs;
    jobs.push_back(gather_block(scene.field, block));
    ++batch_->jobs_left;
    submit_blocks(WorkPool::Urgency::edit, std::move(jobs), {});
  }
  for (const PieceId id : collected_.pieces_added) {
    const auto piece = scene.pieces.find(id);
    if (piece == scene.pieces.end()) continue;  // gone again before it was ever shown
    ++batch_->jobs_left;
    submit_piece(scene.field, id, piece->second);
  }
  batch_->update.removed_pieces = std::move(collected_.pieces_removed);
  collected_ = {};
}

void MeshScheduler::take_generated(Field& field, ChunkCoord chunk, GeneratedChunk&& generated) {
  generating_.erase(chunk);
  const Brick* first = generated.bricks.front();
  const bool uniform = (first == &air_brick() || first == &solid_brick()) &&
                       std::ranges::all_of(generated.bricks, [first](const Brick* b) { return b == first; });
  if (uniform) {
    uniform_[chunk] = first;
  } else {
    field.adopt_generated(chunk, std::move(generated));
  }
}

bool MeshScheduler::generated_around(Field& field, ChunkCoord chunk) {
  bool all = true;
  for_each_around(chunk, [&](ChunkCoord coord) {
    if (uniform_.contains(coord) || field.has_generated(coord)) return;
    all = false;
    if (generating_.size() >= limits::chunks_generating_max || !generating_.insert(coord).second) return;
    pool_.submit(WorkPool::Urgency::load, [inbox = inbox_, source = field.source(), coord] {
      GeneratedChunk generated = generate_chunk(source, coord);
      const std::lock_guard lock(inbox->mutex);
      inbox->generated.push_back({coord, std::move(generated)});
    });
  });
  return all;
}

bool MeshScheduler::is_plainly_empty(const Field& field, ChunkCoord chunk) const {
  const auto own = uniform_.find(chunk);
  if (own == uniform_.end()) return false;
  bool empty = true;
  for_each_around(chunk, [&](ChunkCoord coord) {
    const auto found = uniform_.find(coord);
    empty = empty && found != uniform_.end() && found->second == own->second && field.chunk_hash(coord) == 0;
  });
  return empty;
}

void MeshScheduler::adopt_uniform_around(Field& field, ChunkCoord chunk) {
  for_each_around(chunk, [&](ChunkCoord coord) {
    const auto found = uniform_.find(coord);
    if (found == uniform_.end() || field.has_generated(coord)) return;
    GeneratedChunk generated;
    generated.bricks.fill(found->second);
    field.adopt_generated(coord, std::move(generated));
  });
}

void MeshScheduler::begin_loads(Field& field) {
  size_t examined = 0;
  for (size_t i = pending_.size(); i-- > 0;) {
    if (loading_ >= limits::chunks_loading_max || examined++ >= limits::chunks_examined_max) return;
    if (!generated_around(field, pending_[i])) continue;
    load(field, pending_[i]);
    pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

void MeshScheduler::load(Field& field, ChunkCoord chunk) {
  if (is_plainly_empty(field, chunk)) {
    chunks_[chunk] = ChunkState::loaded;
    return;
  }
  adopt_uniform_around(field, chunk);
  std::vector<BlockJob> jobs;
  for (int i = 0; i < 8; ++i) {
    const BlockCoord block{chunk.x * 2 + (i >> 2), chunk.y * 2 + ((i >> 1) & 1), chunk.z * 2 + (i & 1)};
    BlockJob job = gather_block(field, block);
    if (job.windows) jobs.push_back(std::move(job));
  }
  const bool nothing = jobs.empty();
  chunks_[chunk] = nothing ? ChunkState::loaded : ChunkState::loading;
  if (nothing) return;
  ++loading_;
  submit_blocks(WorkPool::Urgency::load, std::move(jobs), chunk);
}

MeshScheduler::BlockJob MeshScheduler::gather_block(Field& field, BlockCoord block) {
  const VoxelCoord lo{block.x * block_size, block.y * block_size, block.z * block_size};
  const VoxelBox owned{lo, lo + VoxelCoord{block_size, block_size, block_size}};
  return {block, ++gatherings_, gather_windows(field, owned)};
}

void MeshScheduler::submit_blocks(WorkPool::Urgency urgency, std::vector<BlockJob> jobs,
                                  std::optional<ChunkCoord> loaded) {
  pool_.submit(urgency, [inbox = inbox_, jobs = std::move(jobs), loaded] {
    Inbox::Blocks result;
    result.loaded = loaded;
    for (const BlockJob& job : jobs) {
      BlockMesh mesh{job.block, job.gathered, {}};
      if (job.windows) mesh.mesh = job.windows->mesh();
      result.meshes.push_back(std::move(mesh));
    }
    const std::lock_guard lock(inbox->mutex);
    inbox->blocks.push_back(std::move(result));
  });
}

void MeshScheduler::submit_piece(Field& field, PieceId id, const ScenePiece& piece) {
  // A piece lies in the voxel frame of the rock that it was cut from: there it learns which of its faces are
  // fresh.
  Window before = gather_generated(field, piece.volume->window.box);
  pool_.submit(WorkPool::Urgency::edit, [inbox = inbox_, id, piece, before = std::move(before)] {
    PieceMesh done{id, piece, surface_nets_closed(piece.volume->window, &before)};
    const std::lock_guard lock(inbox->mutex);
    inbox->pieces.push_back(std::move(done));
  });
}

}  // namespace scree
