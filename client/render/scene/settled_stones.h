// Stones where pieces merged. A piece that comes to rest becomes terrain, whose voxels keep its mass but not
// its edges, its faces' looks and the gaps beside it. So its drawing stays where it was, in front of that
// terrain, until rock goes from there. For the eye alone: the field decides what is hit, and where one walks.
// Who joins later sees the terrain without these stones.
//
// Whether a piece merged is found from the field: where it lay is rock now. Not thread-safe.
#pragma once

#include <unordered_map>
#include <vector>

#include "client/render/scene/draw_method.h"

namespace scree {

class SettledStones {
 public:
  /// Takes in a frame: the pieces, the field, and what changed. Returns what is to be drawn, pieces and
  /// stones. Pieces that became stones are taken out of `changes.pieces_removed`, and stones that end are put
  /// in.
  const ScenePieces& step(const ScenePieces& pieces, const Field& field, glm::vec3 eye_m,
                          MirrorChanges& changes);
  /// For another world, or another time of it.
  void forget();

  /// What the last step() returned.
  const ScenePieces& shown() const { return shown_; }
  size_t count() const { return stones_.size(); }

 private:
  struct Stone {
    ScenePiece piece;
    std::vector<glm::vec3> inside;  ///< voxels of the field: points of the stone that are rock
  };

  bool lies_in(const Field& field, const Stone& stone) const;
  bool settle(PieceId id, const Field& field);
  void remove(PieceId id, MirrorChanges& changes);
  void end_where_rock_went(const Field& field, MirrorChanges& changes);
  void leave_the_farthest(glm::vec3 eye_m, MirrorChanges& changes);

  ScenePieces last_;   ///< the pieces of the last frame
  ScenePieces shown_;  ///< those of this one, and the stones
  std::unordered_map<PieceId, Stone> stones_;
  std::unordered_map<BrickCoord, std::vector<PieceId>, CoordHash> in_brick_;
};

}  // namespace scree
