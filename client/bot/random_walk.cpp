#include "client/bot/random_walk.h"

#include <cmath>
#include <numbers>

namespace scree {

WalkInput RandomWalk::next() {
  if (ticks_ == 0) {
    if (done_ >= walks_) return {};
    ++done_;
    ticks_ = tick_rate_hz_ + random_.below(2 * tick_rate_hz_);
    const float angle = random_.unit() * 2.0F * std::numbers::pi_v<float>;
    input_.go = glm::vec3(std::cos(angle), 0.0F, std::sin(angle));
    input_.fast = random_.below(2) == 0;
  }
  --ticks_;
  input_.jump = random_.below(2 * tick_rate_hz_) == 0;
  return input_;
}

}  // namespace scree
