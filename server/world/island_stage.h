// Terrain that a change cut off from the ground falls.
//
// Every tick's cuts make one search (shared/field/island_search.h), taken up in the order of the cuts. A tick
// looks at limits::island_bricks_per_tick bricks; what is not finished goes on in the next tick, and starts
// afresh when what it has seen changed in between. With every fresh start its budget doubles, so that each
// search ends. Part of the simulation: it counts bricks, never time.
//
// Switched off (Methods::islands), cuts and unfinished searches wait; switched on again, what they loosened
// meanwhile falls.
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "server/world/tick_delta.h"
#include "server/world/world.h"
#include "shared/field/island_search.h"

namespace scree {

class IslandQueue {
 public:
  /// Searches around bricks that lost rock. Nothing for none.
  void push(std::vector<BrickCoord> cut);
  /// These bricks changed: searches that have read one of them start afresh.
  void changed(std::span<const BrickCoord> bricks);
  /// The islands of the first search in the queue, once it is finished; nothing when `bricks` are used up, or
  /// the queue is empty.
  std::optional<std::vector<Island>> next(Field& field, size_t& bricks);
  bool empty() const { return waiting_.empty(); }
  /// Bricks whose searches are not finished, for people to look at.
  std::vector<BrickCoord> waiting() const;

 private:
  struct Waiting {
    std::vector<BrickCoord> cut;
    std::unique_ptr<IslandSearch> search;  ///< null until its turn comes
    uint32_t restarts = 0;
  };
  std::deque<Waiting> waiting_;
};

/// Finds what this tick's cuts loosened, and lets it fall: after all other changes of the tick, before it is
/// published.
void drop_islands(World::State& state, TickDelta& delta);

/// What merges and islands left hanging loose that is too light for a piece becomes dust
/// (shared/field/specks.h); after carves and dents the search for islands does the same. Whatever the
/// settings; call after the other two.
void sweep_specks(World::State& state, TickDelta& delta);

}  // namespace scree
