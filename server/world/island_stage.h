// Terrain that a change cut off from the ground falls.
//
// Every tick's cuts make one search (shared/falling/island_search.h), taken up in the order of the cuts. A
// tick looks at limits::island_bricks_per_tick bricks; what is not finished goes on in the next tick, and
// starts afresh when what it has seen changed in between. With every fresh start its budget doubles, so that
// each search ends. Part of the simulation: it counts bricks, never time.
//
// What a search found falls in the same tick, as long as the tick's budget of work lasts, and one at least: a
// large island comes in blocks (island_search.h), of which some wait. What waits is searched afresh when
// anything but an island's fall changed what the search had seen: it may have been propped up.
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
#include "shared/falling/island_search.h"

namespace scree {

class IslandQueue {
 public:
  /// Searches around bricks that lost rock. Nothing for none.
  void push(std::vector<BrickCoord> cut);
  /// These bricks changed: searches that have read one of them start afresh.
  void changed(std::span<const BrickCoord> bricks);
  /// These fell: likewise, but what waits to fall is not propped up by that.
  void fell(std::span<const BrickCoord> bricks);
  /// Searches on; false when `bricks` are used up, or nothing is left to search. What the first search found
  /// when it ended waits to fall; returns through `too_large` how many components it took for ground.
  bool search(Field& field, size_t& bricks, uint32_t& too_large);
  /// The next that waits to fall, until pop(). Null: nothing waits.
  const Island* next() const { return falling_.empty() ? nullptr : &falling_.front().islands.back(); }
  void pop();
  /// How many wait to fall.
  size_t falling() const;
  /// Nothing is searched, and nothing waits to fall.
  bool idle() const { return waiting_.empty() && falling_.empty(); }
  /// Bricks whose searches are not finished, for people to look at.
  std::vector<BrickCoord> waiting() const;

 private:
  struct Waiting {
    std::vector<BrickCoord> cut;
    std::unique_ptr<IslandSearch> search;  ///< null until its turn comes
    uint32_t restarts = 0;
  };
  /// What a search found, the next to fall last; never empty.
  struct Falling {
    std::vector<Island> islands;
    std::unique_ptr<IslandSearch> search;
  };
  std::deque<Waiting> waiting_;
  std::deque<Falling> falling_;
};

/// Finds what this tick's cuts loosened, and lets it fall: after the tick's requests, impacts and merges.
void drop_islands(World::State& state, TickDelta& delta);

/// What merges and islands left hanging loose that is too light for a piece becomes dust
/// (shared/recombine/specks.h); after carves and dents the search for islands does the same. Whatever the
/// settings; call after the other two.
void sweep_specks(World::State& state, TickDelta& delta);

}  // namespace scree
