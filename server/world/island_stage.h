// Islands: terrain that a change cut off from the ground falls.
//
// The cuts of a tick and a party (command.h) make one search (shared/falling/island_search.h); a party's
// searches run in the order of its cuts, and parties take turns (turn_queue.h). A tick looks at as many
// bricks as it has room for (limits::island_bricks_per_tick_min, _max), and a chunk whose terrain may have to
// be generated counts as its price is. An unfinished search continues in the party's next turn, and restarts
// when a brick that it has read changed in between. Each restart doubles its budget, so that every search
// ends. Part of the simulation: it counts, never time.
//
// The islands that a search found fall in the same tick, at least one, and more as far as the tick's budget
// of work goes; the others wait, and fall by the parties' turns. A large island comes in blocks
// (island_search.h), which fall one by one. Waiting islands are searched again when a brick that they touch
// changed by anything but the fall of an island: they may have a support now. What fell from them and leans
// on them is none: it becomes terrain when they have fallen, too (merge_stage.cpp).
//
// While Methods::islands is off, cuts and unfinished searches wait; when it is on again, they continue.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "server/formats/world_value.h"
#include "server/work/turn_queue.h"
#include "server/world/rules.h"
#include "server/world/tick_delta.h"
#include "server/world/world.h"
#include "shared/falling/island_search.h"

namespace scree {

/// What a tick's searches may read, and what came of them.
struct SearchAllowance {
  size_t bricks = 0;       ///< left to read; a search that began again reads more for each of them
  size_t read = 0;         ///< bricks that were read
  uint32_t too_large = 0;  ///< components that were taken for ground
};

class IslandQueue {
 public:
  /// Adds a search around bricks that lost rock by this party's doing; none for an empty list. `hung`: boxes
  /// of islands that waited there.
  void push(uint64_t party, std::vector<BrickCoord> loosened, std::vector<VoxelBox> hung = {});
  /// Nobody is passed over any more.
  void begin_tick();
  /// Restarts the unfinished searches that have read one of these changed bricks, and the finished ones of
  /// which an island that waits touches one; before rules::joints, also those that have read one.
  void changed(std::span<const BrickCoord> bricks, uint32_t rules);
  /// The same for bricks that the fall of an island changed: finished searches stay valid.
  void fell(std::span<const BrickCoord> bricks);
  /// Continues the search whose turn it is, as far as `allowance` allows. True when it ended: its islands
  /// wait to fall. False when no bricks are left or there is no search.
  /// `holding`: as of SearchLimits.
  bool search(Field& field, SearchAllowance& allowance, uint32_t rules = rules::newest,
              const Holding* holding = nullptr);
  /// The next island that waits to fall, valid until pop(); null when none waits but of parties that were
  /// passed over.
  const Island* next() const { return falling_.empty() ? nullptr : &falling_.next().islands.back(); }
  /// The party of the next island; there must be one.
  uint64_t next_party() const { return falling_.whose(); }
  /// Removes the next island, and charges its party; there must be one.
  void pop(float charged_us);
  /// Leaves the islands of the next one's party out until begin_tick().
  void pass_over() { falling_.pass_over(); }

  /// Number of islands that wait to fall.
  size_t falling() const;
  /// Whether one of them, or one that is searched again, may touch what lies in the box.
  bool hangs_at(const VoxelBox& box) const;
  /// Searches and islands that wait, of a party.
  struct Backlog {
    size_t searches = 0;
    size_t falls = 0;

    size_t count() const { return searches + falls; }
  };
  Backlog backlog(uint64_t party) const;
  /// Searches and islands that wait, of all parties; how many parties have some, and whether another one has.
  size_t size() const { return waiting_.size() + falling(); }
  size_t parties() const;
  bool others_wait(uint64_t party) const;
  /// Whether the party has no search, and no island that waits to fall.
  bool idle(uint64_t party) const { return !waiting_.waits(party) && !falling_.waits(party); }
  /// Searches that find the same again, by party: first for its islands that wait to fall, then the
  /// unfinished ones.
  std::vector<LooseningEdit> value() const;
  /// Goes on with these. Whose turn it was is forgotten.
  void restore(const std::vector<LooseningEdit>& value);
  /// Bricks of unfinished searches, for display.
  std::vector<BrickCoord> waiting() const;

 private:
  /// Whether a finished search, whose islands still wait, found all that a search around these bricks would.
  bool is_known(uint64_t party, std::span<const BrickCoord> loosened) const;

  struct Waiting {
    std::vector<BrickCoord> loosened;
    std::unique_ptr<IslandSearch> search;  ///< null until its turn
    uint32_t restarts = 0;
    float cost_us = 0.0F;          ///< not known before
    std::vector<VoxelBox> hung{};  ///< of islands that waited to fall before a brick beside them changed
  };
  /// The islands that a search found, the next to fall last; never empty.
  struct Falling {
    /// Bricks in which they begin: a search around these finds them again.
    std::vector<BrickCoord> starts() const;
    std::vector<VoxelBox> boxes() const;

    std::vector<Island> islands;
    std::unique_ptr<IslandSearch> search;
    float cost_us = 0.0F;  ///< of the next island
    bool stale = false;    ///< a brick that the search read has changed
  };
  TurnQueue<Waiting> waiting_;
  TurnQueue<Falling> falling_;
};

/// Refuses, by name, a request of a party that has caused so many falls that those of another one would wait
/// too long (limits::falls_waiting_max, falls_wait_max_s).
Result<void> may_cause_falls(const World::State& state, uint64_t party);

/// Searches around this tick's cuts, and drops the islands found. Call after requests, impacts and merges.
void drop_islands(World::State& state, TickDelta& delta);

/// Turns loose terrain that is too light for a piece, as merges and falling islands leave it, into dust
/// (shared/recombine/specks.h). The search for islands does the same after carves and dents. Does not depend
/// on settings. Call after drop_islands() and break_overloads().
void sweep_specks(World::State& state, TickDelta& delta);

}  // namespace scree
