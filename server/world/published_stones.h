// The stones where pieces merged, as published so far (StoneKeeper), by id and by a chunk in which they
// lie. Not thread-safe.
#pragma once

#include <map>
#include <unordered_map>
#include <vector>

#include "server/world/tick_delta.h"

namespace scree {

class PublishedStones {
 public:
  void apply(const TickDelta& delta) {
    for (const PlacedStone& gone : delta.stones_gone) {
      if (stones_.erase(gone.stone.id) == 0) continue;
      const auto here = in_chunk_.find(gone.chunk);
      std::erase(here->second, gone.stone.id);
      if (here->second.empty()) in_chunk_.erase(here);
    }
    for (const PlacedStone& placed : delta.stones)
      if (stones_.try_emplace(placed.stone.id, placed).second)
        in_chunk_[placed.chunk].push_back(placed.stone.id);
  }

  const std::map<PieceId, PlacedStone>& all() const { return stones_; }
  /// The stones of a chunk; null: it has none.
  const std::vector<PieceId>* in(ChunkCoord chunk) const {
    const auto found = in_chunk_.find(chunk);
    return found == in_chunk_.end() ? nullptr : &found->second;
  }

 private:
  std::map<PieceId, PlacedStone> stones_;
  std::unordered_map<ChunkCoord, std::vector<PieceId>, CoordHash> in_chunk_;
};

}  // namespace scree
