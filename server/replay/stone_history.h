// The stones of all ticks that a replay has played, so that a jump back shows them again: recordings keep
// none. Beyond 32,768 stones the first ones are remembered alone. Not thread-safe.
#pragma once

#include <limits>
#include <map>
#include <vector>

#include "server/world/tick_delta.h"

namespace scree {

class StoneHistory {
 public:
  /// A tick that was played; again, it has the same stones.
  void note(const TickDelta& delta);
  /// Those that lie after a tick, as far as they are known; by id.
  std::vector<SettledStone> at(Tick tick) const;

 private:
  struct Row {
    SettledStone stone;
    Tick began = 0;
    Tick ended = std::numeric_limits<Tick>::max();
  };
  std::map<PieceId, Row> rows_;
};

}  // namespace scree
