// The motions of a client's pieces: which it knows, and how a frame takes them a step further. Not
// thread-safe.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "proto/motion_codec.h"
#include "shared/operation/operation.h"

namespace scree {

class KnownMotions {
 public:
  KnownMotions(const MotionRules& rules, float voxel_size_m) : rules_(rules), voxel_size_m_(voxel_size_m) {}

  /// A piece that was sent whole: its motion is not known until a frame tells it. The id must be new.
  void add(PieceId id, const Volume& volume) { add(id, volume.centre_voxels * voxel_size_m_); }
  /// The same of what has its origin there, in its own frame: a prop has it at 0.
  void add(PieceId id, glm::vec3 centre_m);
  /// A piece that an operation made. It goes on from its parent's motion, and has none if that is not known
  /// or the parent is not here. The id must be new.
  void add_made(PieceId id, const Volume& volume, std::optional<PieceId> parent);
  void remove(PieceId id) { pieces_.erase(id); }
  void clear() { pieces_.clear(); }

  /// Takes every known motion a step further (FrameMessage::motions). Returns the pieces whose poses may be
  /// others, ordered. After an error the motions are of no use.
  Result<std::vector<PieceId>> advance(std::span<const uint8_t> motions);

  size_t size() const { return pieces_.size(); }
  /// Null if the piece or its motion is not known.
  const Motion* motion(PieceId id) const;

 private:
  struct Piece {
    glm::vec3 centre_m{0.0F};  ///< of the volume, in its own frame
    std::optional<Motion> motion;
    uint32_t check = 0;  ///< motion_check() of it
  };
  static void set(PieceId id, Piece& piece, const Motion& motion);
  MotionRules rules_;
  float voxel_size_m_;
  std::map<PieceId, Piece> pieces_;
};

}  // namespace scree
