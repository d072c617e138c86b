// A bot's walks on foot: random directions for a second to three, some of them running or jumping. The same
// seed gives the same inputs.
#pragma once

#include <cstdint>

#include "shared/base/random.h"
#include "shared/base/walking.h"

namespace scree {

class RandomWalk {
 public:
  RandomWalk(uint32_t walks, uint32_t tick_rate_hz, uint64_t random_seed)
      : walks_(walks), tick_rate_hz_(tick_rate_hz), random_(random_seed) {}

  bool is_over() const { return done_ >= walks_ && ticks_ == 0; }
  /// Walks that are over.
  uint32_t done() const { return ticks_ == 0 ? done_ : done_ - 1; }
  /// The input of the next tick, until it is over.
  WalkInput next();

 private:
  uint32_t walks_;
  uint32_t tick_rate_hz_;
  Random random_;
  WalkInput input_;
  uint32_t ticks_ = 0;  ///< that are left of this walk
  uint32_t done_ = 0;   ///< walks that have begun
};

}  // namespace scree
