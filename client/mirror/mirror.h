// A client's copy of the world, without any drawing: applies what the server sends, checks hashes,
// interpolates pieces.
//
// Time: apply() applies a message at once. A viewer that wants smooth motion delays each Frame until its
// playback clock reaches the frame's tick. Not thread-safe. Invariant: the edited bricks of every held chunk
// are the server's as of the last frame, unless a check failed; then a repair request waits or is sent.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "proto/known_motions.h"
#include "proto/messages.h"
#include "shared/field/field.h"
#include "shared/material/palette.h"
#include "shared/operation/operation.h"
#include "shared/operation/per_operation.h"
#include "shared/query/scene_maker.h"
#include "shared/recombine/settled_stone.h"

namespace scree {

/// The changes by a message, for owners of meshes.
struct MirrorChanges {
  std::vector<BrickCoord>
      bricks;  ///< codes or paint changed (or forgotten: generated again); some may come twice
  std::vector<PieceId> pieces_added;
  std::vector<PieceId> pieces_removed;
  std::vector<PieceId> props_added{};
  std::vector<PieceId> props_removed{};
  std::vector<JointId> joints_changed{};  ///< that are new, or have another motor
  std::vector<EndedJoint> joints_removed{};
  /// Pieces that merged now, or before this client came there, for the eye. The mirror keeps none.
  std::vector<SettledStone> stones{};
  bool palette = false;  ///< Mirror::palette() is another one
  bool regions = false;  ///< Mirror::regions() are others
  /// An image of the palette has come whole (Client::content).
  std::optional<Digest> image{};
};

/// On the way between two known poses.
struct BetweenPoses {
  Pose from;
  Pose to;
  Tick from_tick = 0;
  Tick to_tick = 0;
};

/// A piece between two known poses.
struct PieceMotion : BetweenPoses {
  std::shared_ptr<const Volume> volume;
};

/// A prop, likewise.
struct PropMotionHere : BetweenPoses {
  std::shared_ptr<const Prop> prop;
};

/// Counts of applied messages and their content since the welcome.
struct MirrorCounters {
  uint64_t frames = 0;
  OperationCounts operations;
  uint64_t operation_bytes = 0;
  uint64_t patched_bricks = 0;
  uint64_t transforms = 0;  ///< poses, predicted ones too
  uint64_t transform_bytes = 0;
  uint64_t chunks = 0;       ///< received whole, or their last part
  uint64_t chunk_parts = 0;  ///< received, the last ones too
  uint64_t chunks_kept = 0;  ///< taken from what was kept
  uint64_t dropped_chunks = 0;
  uint64_t pieces_made = 0;    ///< by operations
  uint64_t pieces_sent = 0;    ///< received whole
  uint64_t pieces_merged = 0;  ///< by operations
  uint64_t props_sent = 0;
  uint64_t checks = 0;
  uint64_t mismatches = 0;       ///< frames whose check failed
  uint64_t repairs_asked = 0;    ///< chunks
  uint64_t repairs_arrived = 0;  ///< chunks
  uint64_t resets = 0;

  MirrorCounters& operator+=(const MirrorCounters& other);
};

/// The edits of a chunk that the client has kept from earlier; empty when it has none.
using FindCachedChunk = std::function<std::vector<BrickPatch>(ChunkCoord)>;

class Mirror {
 public:
  /// `find_cached`: what was offered to the server.
  explicit Mirror(const WelcomeMessage& welcome, FindCachedChunk find_cached = {});

  /// Applies one message. A message that cannot be applied (unknown piece, wrong base) is an error: the
  /// mirror cannot be used any more, and the caller connects again.
  Result<MirrorChanges> apply(const ServerMessage& message);

  /// Takes the next request to send to the server, of chunks whose frame had another check. Call until there
  /// is nothing.
  std::optional<RepairMessage> next_repair_request();

  const std::map<PieceId, PieceMotion>& pieces() const { return motions_; }
  /// Those of them that never become terrain until they are released, as far as the server says it.
  const std::set<PieceId>& kept() const { return kept_; }
  const std::map<PieceId, PropMotionHere>& props() const { return props_; }
  /// Their bodies are known here.
  const std::map<JointId, Joint>& joints() const { return joints_; }
  /// All regions of the world, ordered by id.
  const std::vector<Region>& regions() const { return regions_; }
  /// What the server's rules show to this client, in order; their ends are not looked at (Sign::until).
  const std::vector<Sign>& signs() const { return signs_; }
  /// Who is on foot, by the props that are their bodies: a session each. Not all bodies are known here.
  const std::map<PieceId, uint64_t>& persons() const { return persons_; }
  /// This client's own person, as the server told it last; nothing: it is not on foot.
  const std::optional<OwnPerson>& own_person() const { return own_person_; }
  /// What the own store has, as far as the server says it.
  const MaterialMasses& carried() const { return carried_; }
  /// Pose at a (fractional) tick, clamped to the known poses.
  Pose pose_at(const BetweenPoses& motion, double tick) const;

  /// What questions about space (shared/query/query.h) are asked of, as of the last frame: the terrain that
  /// is held, and the pieces and props that are known, at their last poses. Those of a client that gets
  /// motions are within 2 mm of the server's. It holds until the next message is applied.
  HeldScene scene();

  Field& field() { return field_; }
  const Field& field() const { return field_; }
  const TerrainSource& terrain() const { return field_.source(); }
  /// What the world is made of, as far as it has come; never null.
  const std::shared_ptr<const Palette>& palette() const { return palette_; }
  void set_palette(std::shared_ptr<const Palette> palette) { palette_ = std::move(palette); }
  /// Chunks that follow the server: their edited bricks are exactly the server's.
  const std::unordered_set<ChunkCoord, CoordHash>& held_chunks() const { return held_; }
  Tick tick() const { return tick_; }                           ///< of the last frame applied
  uint64_t mismatches() const { return counters_.mismatches; }  ///< frames whose check failed
  const std::optional<StatusMessage>& status() const { return status_; }
  const MirrorCounters& counters() const { return counters_; }

 private:
  using ChunkSet = std::unordered_set<ChunkCoord, CoordHash>;
  struct Mismatch {
    Tick tick = 0;
    uint64_t hash = 0;
  };

  /// The voxel frame of new pieces' volumes, and its place in the world.
  struct Birthplace {
    Pose pose;
    glm::vec3 centre_voxels{0.0F};
  };

  Birthplace birthplace_of(const Operation& operation) const;
  Result<void> apply_frame(const FrameMessage& frame, MirrorChanges& changes);
  /// `work_us`: of the frame's operations so far.
  Result<void> apply_operation(const Operation& operation, Tick tick, float& work_us, ChunkSet& changed,
                               MirrorChanges& changes);
  void apply_patches(const std::vector<BrickPatch>& patches, ChunkSet& changed, MirrorChanges& changes);
  Result<void> apply_transforms(const std::vector<uint8_t>& packed, Tick tick);
  Result<void> apply_motions(const std::vector<uint8_t>& motions, Tick tick);
  /// What a piece or a prop has; null: it is not known here.
  BetweenPoses* find_moving(PieceId id);
  void move(BetweenPoses& motion, const Pose& to, Tick tick) const;
  Result<void> apply_chunk(const ChunkMessage& message, MirrorChanges& changes);
  void apply_unchanged(const UnchangedChunksMessage& message, MirrorChanges& changes);
  Result<void> apply_part(const ChunkMessage& message, MirrorChanges& changes);
  void forget_all_but(uint64_t edited, ChunkCoord chunk, MirrorChanges& changes);
  void replace_chunk(ChunkCoord chunk, const std::vector<BrickPatch>& bricks, MirrorChanges& changes);
  Result<void> apply_piece(const PieceMessage& message, MirrorChanges& changes);
  Result<void> apply_stone(const StoneMessage& message, MirrorChanges& changes);
  /// Tells of the pieces that the operation, which is not applied yet, makes terrain.
  void note_merge(const Operation& operation, MirrorChanges& changes) const;
  Result<void> apply_prop(const PropMessage& message, MirrorChanges& changes);
  Result<void> apply_kept(const KeptPiecesMessage& message);
  Result<void> apply_regions(const RegionsMessage& message, MirrorChanges& changes);
  Result<void> apply_persons(const PersonPlacesMessage& message);
  Result<void> apply_stores(const StoresMessage& message);
  Result<void> apply_joints(const JointsMessage& message, MirrorChanges& changes);
  void forget_joint(const EndedJoint& gone, MirrorChanges& changes);
  void forget_joints_of(PieceId body, MirrorChanges& changes);
  void apply_reset(MirrorChanges& changes);
  Result<void> within_limits() const;

  void set_bricks(const std::vector<BrickPatch>& bricks, MirrorChanges& changes);
  void check(const FrameMessage& frame, const ChunkSet& changed);
  void forget_chunk(ChunkCoord chunk, MirrorChanges& changes);
  void add_piece(PieceId id, std::shared_ptr<const Volume> volume, const Pose& pose, Tick tick,
                 MirrorChanges& changes);
  void remove_piece(PieceId id, MirrorChanges& changes);
  /// A piece, or a prop.
  void remove(PieceId id, MirrorChanges& changes);
  void count(const Operation& operation);

  FindCachedChunk find_cached_;
  std::shared_ptr<const Palette> palette_ = plain_palette();
  MapField field_;
  PieceTable table_;                        ///< the pieces, for apply() of operations
  std::map<PieceId, PieceMotion> motions_;  ///< their poses
  std::set<PieceId> kept_;
  std::vector<Region> regions_;
  std::vector<Sign> signs_;
  std::map<PieceId, PropMotionHere> props_;
  std::map<JointId, Joint> joints_;
  std::map<PieceId, uint64_t> persons_;  ///< sessions by body
  std::optional<OwnPerson> own_person_;
  uint64_t session_;  ///< this client's
  MaterialMasses carried_;
  std::map<PieceId, std::set<JointId>> joints_of_;  ///< by body; none is empty
  KnownMotions known_motions_;                      ///< by which they are predicted, pieces and props
  size_t piece_voxels_ = 0;                         ///< of their volumes, together
  ChunkSet held_;
  ChunkSet incomplete_;  ///< a part has come, and not the last one: not held
  Tick tick_;
  uint32_t ticks_per_transform_;
  std::optional<StatusMessage> status_;
  std::map<ChunkCoord, Mismatch> mismatched_;  ///< not requested yet
  std::unordered_map<ChunkCoord, Tick, CoordHash>
      repairs_awaited_;  ///< requested, of held chunks, with the tick of the check
  MirrorCounters counters_;
  SceneMaker scenes_;
};

}  // namespace scree
