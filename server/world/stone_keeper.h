// Keeps the stones that lie where pieces merged (shared/recombine/settled_stone.h), so that who comes later
// sees what those see who were there. It follows the ticks of a world or of a replay, and notes in each what
// began and what ended. For the eye alone: it decides nothing, and no hash has it. Bounded by
// limits::kept_stones_max and kept_stone_bytes_max; the stones of the oldest pieces go first. Not
// thread-safe.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "server/world/tick_delta.h"
#include "shared/field/field.h"
#include "shared/operation/operation.h"

namespace scree {

class StoneKeeper {
 public:
  /// Begins with these pieces, which have ids below `next_piece`, and with these stones. It leaves out stones
  /// that no such world has, as they may come from a file.
  void restart(const PieceTable& pieces, std::span<const SettledStone> stones, PieceId next_piece,
               const Field& field);
  /// The tick's operations and bricks are whole in the delta, and applied to the field.
  void follow(const Field& field, TickDelta& delta);

  /// Ordered by id.
  std::vector<SettledStone> value() const;
  std::vector<PlacedStone> all() const;

 private:
  void merge(const StampOperation& stamp, const Field& field, TickDelta& delta);
  void settle(const StampedPiece& piece, const Field& field, TickDelta& delta);
  void insert(SettledStone stone, StonePoints points, const Field& field);
  /// The stone has no place any more. Returns it.
  PlacedStone take(PieceId id);

  std::map<PieceId, std::shared_ptr<const Volume>> alive_;
  std::map<PieceId, PlacedStone> stones_;
  StonePlaces places_;
  size_t bytes_ = 0;  ///< of the stones' volumes
};

}  // namespace scree
