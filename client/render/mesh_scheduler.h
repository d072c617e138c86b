// Decides which meshes are built, when, and which of them are shown together. No GL: it can be tested alone.
//
// Terrain is meshed in blocks of 16³ voxels, loaded chunk by chunk, nearest first. Changes are gathered in
// batches: one is in the works while the next collects; its blocks and pieces are shown as one, when all of
// them are ready, and until then what was there stays. So there is never a hole, and never a piece beside the
// rock that it has become.
//
// Called from one thread; windows are copied out of the field there, generating and meshing run on the pool.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "client/render/draw_method.h"
#include "client/render/work_pool.h"
#include "shared/field/surface_nets.h"

namespace scree {

inline constexpr int block_size = 16;  ///< voxels a side
using BlockCoord = Coord<struct BlockTag>;

struct BlockMesh {
  BlockCoord block;
  uint64_t gathered = 0;  ///< number of the gathering; of two meshes of a block the later one counts
  SurfaceMesh mesh;
};

struct PieceMesh {
  PieceId id = 0;
  ScenePiece piece;  ///< as it was when the mesh was begun
  SurfaceMesh mesh;
};

/// What to show from now on, as one.
struct MeshUpdate {
  std::vector<BlockMesh> blocks;  ///< replace what the block showed; empty ones show nothing
  std::vector<ChunkCoord> dropped_chunks;
  std::vector<PieceMesh> pieces;
  std::vector<PieceId> removed_pieces;
};

class MeshScheduler {
 public:
  MeshScheduler(WorkPool& pool, float view_radius_m);
  ~MeshScheduler();

  void changed(const MirrorChanges& changes);
  /// Work that is done comes back; work that is needed begins.
  MeshUpdate update(const Scene& scene, glm::vec3 eye_m);
  /// All chunks within the view are shown, and all that was changed before the first update().
  bool loaded() const { return caught_up_ && pending_.empty() && loading_ == 0; }
  bool complete() const { return caught_up_ && waiting() == 0; }
  /// Chunks and changes not yet shown.
  size_t waiting() const;

 private:
  enum class ChunkState : uint8_t { loading, loaded };
  struct BlockJob;
  struct Inbox;  ///< results, filled by the workers
  struct Batch;

  void take_results(Field& field, MeshUpdate& update);
  void show(BlockMesh&& mesh, MeshUpdate& update);
  void follow(const TerrainSource& source, glm::vec3 eye_m, MeshUpdate& update);
  void begin_batch(const Scene& scene);
  void begin_loads(Field& field);
  bool generated_around(Field& field, ChunkCoord chunk);
  void load(Field& field, ChunkCoord chunk);
  bool is_plainly_empty(const Field& field, ChunkCoord chunk) const;
  void adopt_uniform_around(Field& field, ChunkCoord chunk);
  void take_generated(Field& field, ChunkCoord chunk, GeneratedChunk&& generated);
  BlockJob gather_block(Field& field, BlockCoord block);
  void submit_blocks(WorkPool::Urgency urgency, std::vector<BlockJob> jobs, std::optional<ChunkCoord> loaded);
  void submit_piece(Field& field, PieceId id, const ScenePiece& piece);

  WorkPool& pool_;
  float view_radius_m_;
  std::shared_ptr<Inbox> inbox_;
  bool started_ = false;
  ChunkCoord centre_;                ///< chunk of the eye
  std::vector<ChunkCoord> pending_;  ///< to be loaded, nearest last
  std::unordered_map<ChunkCoord, ChunkState, CoordHash> chunks_;
  std::unordered_set<ChunkCoord, CoordHash> generating_;
  /// Chunks generated as nothing but this brick. Most of them lie far from any surface: the field, which
  /// keeps a limited number, is handed only those that it is asked for.
  std::unordered_map<ChunkCoord, const Brick*, CoordHash> uniform_;
  size_t loading_ = 0;
  std::unordered_map<BlockCoord, uint64_t, CoordHash> shown_;  ///< number of the gathering that is shown
  uint64_t gatherings_ = 0;
  MirrorChanges collected_;       ///< since the batch in the works was begun
  bool caught_up_ = false;        ///< the first batch is shown
  std::unique_ptr<Batch> batch_;  ///< in the works, or null
};

}  // namespace scree
