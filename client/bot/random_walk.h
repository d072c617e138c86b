// A bot's walks on foot: random directions for a second to three, some of them running or jumping. The same
// seed gives the same inputs.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "shared/base/random.h"
#include "shared/base/walking.h"

namespace scree {

/// Who leaves such a square turns back; y does not matter.
struct WalkSquare {
  glm::vec3 middle_m{0.0F};
  float half_m = 0.0F;

  bool has(glm::vec3 place_m) const;
};

class RandomWalk {
 public:
  RandomWalk(uint32_t walks, uint32_t tick_rate_hz, uint64_t random_seed,
             std::optional<WalkSquare> square = {})
      : walks_(walks), tick_rate_hz_(tick_rate_hz), random_(random_seed), square_(square) {}

  bool is_over() const { return done_ >= walks_ && ticks_ == 0; }
  /// Walks that are over.
  uint32_t done() const { return ticks_ == 0 ? done_ : done_ - 1; }
  /// The input of the next tick, until it is over, of somebody who stands there.
  WalkInput next(glm::vec3 feet_m);

 private:
  uint32_t walks_;
  uint32_t tick_rate_hz_;
  Random random_;
  std::optional<WalkSquare> square_;
  WalkInput input_;
  uint32_t ticks_ = 0;  ///< that are left of this walk
  uint32_t done_ = 0;   ///< walks that have begun
};

}  // namespace scree
