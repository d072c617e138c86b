// One client's knowledge of the world, and the selection of what to send next: no bytes, no sockets.
//
// Invariants: `held` chunks on the client are exactly as published, once it has applied everything selected
// so far (TCP keeps the order). A chunk that was never edited is known to every client that has the tiles of
// the ground which decide it; a ground that is generated has none.
// An edited chunk within interest is held or wanted, never both; a stale chunk is wanted and not held, and
// its bricks that the client does not lack are exactly as published.
// `known` pieces are those that the client has. Lengths in metres. Not thread-safe.
//
// A client gets operations of the kinds that it says it carries out, and no others. One without kernels,
// which knows none of them, never gets an operation: the bricks that operations changed come as patches,
// within a budget of bricks, or with their whole chunk, and pieces come whole.
#pragma once

#include <boost/container/flat_map.hpp>
#include <cstdint>
#include <glm/vec3.hpp>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "server/publish/limits.h"
#include "server/publish/motions.h"
#include "server/world/published_state.h"

namespace scree {

using ChunkSet = std::unordered_set<ChunkCoord, CoordHash>;

/// Chunks that the tick changes or reads, and in which nothing was edited before. `before`: the state before
/// the tick.
ChunkSet unedited_before(const TickDelta& delta, const PublishedState& before);

/// The changes of a tick, prepared once for all clients. `state` and `motions` are those after the tick.
struct TickChanges {
  const TickDelta& delta;
  const PublishedState& state;
  const Motions& motions;
  float voxel_size_m = 0.0F;
  std::unordered_map<ChunkCoord, std::vector<const BrickState*>, CoordHash> bricks;
  std::vector<std::vector<PieceId>> ended;     ///< by each operation
  std::vector<std::vector<ChunkCoord>> needs;  ///< chunks with edits before, which each reads or writes
  std::vector<std::vector<ChunkCoord>> opens;  ///< chunks without edits before, which each writes
  std::vector<std::set<TileKey>> tiles;        ///< of the ground, if it has any, that decide what each reads
  ChunkSet fresh;                              ///< changed for the first time in this tick
  ChunkSet reverted;                           ///< with bricks that are no longer edited
  ChunkSet orphan;                             ///< changed, but by no operation (in a keyframe)

  /// `unedited`: of the tick, made before it was applied.
  TickChanges(const TickDelta& delta, const ChunkSet& unedited, const PublishedState& after,
              const Motions& motions, const TerrainSource& ground);
};

/// A frame's content, by reference into the tick. Clients with equal selections get the same bytes.
struct FrameSelection {
  std::vector<uint32_t> operations;  ///< indices into TickDelta::operations
  std::vector<ChunkCoord> patched;   ///< their bricks that changed in this tick are sent
  std::vector<ChunkCoord> dropped;
  std::vector<PieceId> removed;
  std::vector<PieceId> steps;     ///< their motions go on from those that the client has
  std::vector<PieceId> wholes;    ///< their motions come whole
  std::vector<PieceState> moved;  ///< for a client that does not predict
  bool has_check = false;
  uint32_t check = 0;

  bool operator==(const FrameSelection&) const = default;
  bool is_empty() const { return *this == FrameSelection{}; }
};

/// What a frame may have besides the tick's operations.
struct FrameScope {
  bool poses = true;  ///< poses, and removals of pieces that ended or left the interest
  size_t patch_bricks = limits::patch_bricks_max;  ///< beyond, chunks are wanted whole, later
  bool scan = true;  ///< an interest that has changed may be scanned for edited chunks
};

class ClientView {
 public:
  /// The radius is not negative. `operations`: kinds of operation that the client carries out, from the first
  /// on; 0: it has no kernels.
  ClientView(glm::vec3 eye_m, float radius_m, size_t operations);

  glm::vec3 eye_m() const { return next_eye_m_; }
  float radius_m() const { return next_radius_m_; }
  /// Whether the interest has changed and may be scanned in the frame of this tick.
  bool wants_scan(Tick tick) const {
    return rescan_due_ && (rescanned_ == 0 || tick >= rescanned_ + limits::rescan_ticks_min);
  }
  /// Changes eye and radius within limits::rescan_ticks_min ticks. The radius is not negative.
  void set_interest(glm::vec3 eye_m, float radius_m);
  /// Whether the chunk lies within the interest as last set, times limits::interest_keep_factor.
  bool may_see(ChunkCoord chunk, float voxel_size_m) const;

  /// Selects the frame of a tick, and notes it as sent. Call once for each tick whose frame is sent.
  /// `parts.poses`: includes poses, and removes pieces that ended or left the interest; the motions have just
  /// gone a step.
  FrameSelection select_frame(const TickChanges& changes, FrameScope parts);

  /// Up to `count` chunks (pieces) to send whole, nearest first; pieces right after a frame with poses.
  std::vector<ChunkCoord> next_chunks(const TickChanges& changes, size_t count) const;
  std::vector<PieceId> next_pieces(const Motions& motions, size_t count) const;
  /// Bricks of a wanted chunk that the client does not have as they are: bit i for brick i (index_in_chunk),
  /// edited or not.
  uint64_t lacks(ChunkCoord chunk) const;
  /// Notes that these bricks of a wanted chunk were sent. True when none of `edited` is lacking any more:
  /// from now on the chunk is followed.
  bool sent_bricks(ChunkCoord chunk, uint64_t bricks, uint64_t edited);
  /// Notes that a chunk (piece) was sent whole: from now on it is followed.
  void sent_chunk(ChunkCoord chunk);
  void sent_piece(PieceId piece, const QuantisedPose& pose);

  /// Notes that the client's copy of a chunk is wrong: if it is held, it will be sent again, whole.
  void distrust(ChunkCoord chunk);
  /// Notes that the client has no edits and no pieces.
  void reset();

  /// Notes that the client has a tile of the ground, or gets it before what comes next.
  void hold_tile(TileKey key) { tiles_.insert(key); }
  bool holds_tile(TileKey key) const { return tiles_.contains(key); }

  const ChunkSet& held() const { return held_; }
  bool wants(ChunkCoord chunk) const { return wanted_.contains(chunk); }
  bool knows(PieceId piece) const {
    const auto known = known_.find(piece);
    return known != known_.end() && !known->second.gone;
  }
  size_t known_pieces() const;
  size_t wanted_chunks() const { return wanted_.size(); }
  /// As wanted_chunks(), but never 0 while the interest has changed and was not scanned yet.
  size_t chunks_waiting() const { return wanted_.size() + (rescan_due_ ? 1U : 0U); }

 private:
  /// Small, for a client's walk over its pieces costs by the memory that it touches.
  struct Known {
    bool has_motion = false;  ///< as of the last frame with poses, or of the piece's birth
    bool gone = false;        ///< the client has it no more; the next walk takes the entry out
  };
  bool has_kernels() const { return operations_ != 0; }
  float distance_m(ChunkCoord chunk, float voxel_size_m) const;
  bool near(ChunkCoord chunk, float voxel_size_m) const;
  bool near(glm::vec3 place_m, float factor) const;
  bool can_apply(size_t operation, const TickChanges& changes, const ChunkSet& tainted) const;
  bool concerns(size_t operation, const TickChanges& changes) const;
  void select_operations(const TickChanges& changes, FrameSelection& frame, ChunkSet& tainted,
                         ChunkSet& changed);
  void select_patches(const TickChanges& changes, const ChunkSet& tainted, size_t room, FrameSelection& frame,
                      ChunkSet& changed);
  void select_reverted(const TickChanges& changes, FrameSelection& frame, ChunkSet& tainted);
  /// The bricks of a chunk changed, and the client is not told.
  void miss(ChunkCoord chunk, uint64_t bricks);
  size_t patch_room(size_t most);
  void select_poses(const TickChanges& changes, FrameSelection& frame);
  void select_pose(const TrackedMotion& piece, const TickChanges& changes, Known& known,
                   FrameSelection& frame);
  void rescan(const TickChanges& changes, const ChunkSet& changed, FrameSelection& frame);
  /// False when the client does not have it.
  bool forget(PieceId piece);
  /// Whether the invariants hold, and `changed` chunks are held; for CHECK_DEBUG.
  bool is_sound(const ChunkSet& changed) const;

  glm::vec3 eye_m_;
  float radius_m_;
  glm::vec3 next_eye_m_;
  float next_radius_m_;
  size_t operations_;           ///< kinds of them that the client carries out
  size_t patch_credit_bricks_;  ///< of a client without kernels
  bool rescan_due_ = true;
  Tick rescanned_ = 0;
  std::set<TileKey> tiles_;  ///< of the ground
  ChunkSet held_;
  /// Not held, but the client has edits there, to be completed, replaced by the whole chunk, or dropped; with
  /// the bricks that it lacks.
  std::unordered_map<ChunkCoord, uint64_t, CoordHash> stale_;
  ChunkSet wanted_;                                   ///< edited, within interest, not held
  boost::container::flat_map<PieceId, Known> known_;  ///< walked in every frame with poses, of every client
  /// For a client without kernels: the last whole pose of each piece that got one since it was cut.
  std::unordered_map<PieceId, QuantisedPose> sent_poses_;
  Tick stepped_ = 0;  ///< the last tick whose frame had poses
};

}  // namespace scree
