// The ticks that questions may ask for: where everything was, and of the bricks that changed since what they
// were before. Volumes, props and bricks are shared and immutable, so a tick costs its poses, and its changed
// bricks. Not thread-safe.
#pragma once

#include <deque>
#include <memory>
#include <unordered_map>
#include <vector>

#include "server/world/published_state.h"
#include "shared/query/scene_maker.h"

namespace scree {

/// A brick before a tick changed it.
struct BrickBefore {
  BrickCoord coord;
  std::shared_ptr<const Brick> brick;  ///< null: as the ground, or unknown
  BrickMaterials materials{};
  bool known = true;  ///< false: it was out of memory
};

struct PastTick {
  Tick tick = 0;
  std::vector<PieceState> pieces;
  std::vector<PieceState> props;
  std::vector<BrickBefore> changed;  ///< by this tick
};

class QueryPast {
 public:
  explicit QueryPast(Tick kept) : kept_(kept) {}

  /// Begins anew with the state as it stands.
  void restart(const PublishedState& state);
  /// Before the state takes the next tick, and after it did.
  void before(const TickDelta& delta, const PublishedState& state);
  void after(const TickDelta& delta, const PublishedState& state);

  /// Null: it is not kept.
  const PastTick* find(Tick tick) const;
  /// Gives the maker all bodies of a tick that is kept.
  void add_bodies(const PastTick& past, SceneMaker& maker) const;
  /// What bricks were after that tick, of all that changed since: the first entry of a brick counts.
  std::vector<const BrickBefore*> changed_since(Tick tick) const;

 private:
  template <typename T>
  struct Kept {
    std::shared_ptr<const T> value;
    Tick gone = 0;  ///< the tick by which it was found to be gone; 0: it is there
  };
  template <typename T>
  using ById = std::unordered_map<PieceId, Kept<T>>;
  template <typename T, typename There>
  void forget_gone(ById<T>& kept, const There& there, Tick now) const;

  Tick kept_;
  std::deque<PastTick> ticks_;  ///< without a gap
  ById<Volume> volumes_;
  ById<Prop> props_;
};

}  // namespace scree
