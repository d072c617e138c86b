// Stones where pieces merged. A piece that comes to rest becomes terrain, whose voxels keep its mass but not
// its edges, its faces' looks and the gaps beside it. So its drawing stays where it was, in front of that
// terrain, until rock goes from there (shared/recombine/settled_stone.h); not while rock covers it. For the
// eye alone: the field decides what is hit, and where one walks. The server tells of pieces that merged
// before the client came.
//
// Operations say which pieces merge. Where bricks come instead, the field says it: where a piece lay is rock
// now. Not thread-safe.
#pragma once

#include <set>

#include "client/render/scene/draw_method.h"
#include "shared/recombine/settled_stone.h"

namespace scree {

class SettledStones {
 public:
  /// Takes in a frame: the pieces, the field, and what changed. Returns what is to be drawn, pieces and
  /// stones. Pieces that became stones are taken out of `changes.pieces_removed`, and stones that end are put
  /// in. Stones whose pieces were not drawn are put into `changes.pieces_added`.
  const ScenePieces& step(const ScenePieces& pieces, const Field& field, glm::vec3 eye_m,
                          MirrorChanges& changes);
  /// For another world, or another time of it.
  void forget();

  /// What the last step() returned.
  const ScenePieces& shown() const { return shown_; }
  size_t count() const { return stones_.size(); }

 private:
  bool settle(PieceId id, const Field& field);
  bool add_told(const SettledStone& told, const Field& field);
  bool add_if_rock(PieceId id, const ScenePiece& piece, uint32_t lies, const Field& field);
  void follow_burials(const Field& field, MirrorChanges& changes);
  /// One that is not among `places_` any more.
  void forget_stone(PieceId id, MirrorChanges& changes);
  void leave_the_farthest(glm::vec3 eye_m, MirrorChanges& changes);

  ScenePieces last_;   ///< the pieces of the last frame
  ScenePieces shown_;  ///< those of this one, and the stones
  ScenePieces stones_;
  StonePlaces places_;
  StonePlaces surfaces_;      ///< of the same stones, but for those too small to have any
  std::set<PieceId> buried_;  ///< stones that are not to be seen
  size_t voxels_ = 0;         ///< of the stones' volumes
};

}  // namespace scree
