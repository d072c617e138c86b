// A client's copy of the world, without any drawing: applies what the server sends, checks hashes,
// interpolates pieces.
//
// Time: messages are applied when they are handed in. A viewer that wants smooth motion holds each Frame back
// until its playback clock reaches the frame's tick. Not thread-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "proto/messages.h"
#include "shared/field/field.h"
#include "shared/field/operation.h"

namespace scree {

/// What a message changed, for those who keep meshes of it.
struct MirrorChanges {
  std::vector<BrickCoord> bricks;  ///< codes changed (or forgotten: generated again)
  std::vector<PieceId> pieces_added;
  std::vector<PieceId> pieces_removed;
};

/// A piece between two known poses.
struct PieceMotion {
  std::shared_ptr<const Volume> volume;
  Pose from;
  Pose to;
  Tick from_tick = 0;
  Tick to_tick = 0;
};

class Mirror {
 public:
  explicit Mirror(const WelcomeMessage& welcome);

  /// Applies one message; what cannot be applied (unknown piece, wrong base) is an error: the connection is
  /// of no use any more, and the caller reconnects.
  Result<MirrorChanges> apply(const ServerMessage& message);

  /// The chunks whose hash did not match after the last frame; empties the list. To be reported to the
  /// server.
  std::optional<RepairRequest> take_repair_request();

  const std::map<PieceId, PieceMotion>& pieces() const;
  /// Pose at a (fractional) tick, clamped to what is known.
  Pose pose_at(const PieceMotion& motion, double tick) const;

  Field& field();
  const TerrainSource& terrain() const;
  /// Chunks that follow the server: their edited bricks are exactly the server's.
  const std::unordered_set<ChunkCoord, CoordHash>& held_chunks() const;
  Tick tick() const;            ///< of the last frame applied
  uint64_t mismatches() const;  ///< frames whose check failed
  const std::optional<StatusMessage>& status() const;
};

}  // namespace scree
