#include "client/bot/random_walk.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace scree {

bool WalkSquare::has(glm::vec3 place_m) const {
  const glm::vec3 off_m = glm::abs(place_m - middle_m);
  return std::max(off_m.x, off_m.z) <= half_m;
}

WalkInput RandomWalk::next(glm::vec3 feet_m) {
  if (ticks_ == 0) {
    if (done_ >= walks_) return {};
    ++done_;
    ticks_ = tick_rate_hz_ + random_.below(2 * tick_rate_hz_);
    const float angle = random_.unit() * 2.0F * std::numbers::pi_v<float>;
    input_.go = glm::vec3(std::cos(angle), 0.0F, std::sin(angle));
    input_.fast = random_.below(2) == 0;
  }
  if (square_ && !square_->has(feet_m)) {
    const glm::vec3 back_m = square_->middle_m - feet_m;
    input_.go = glm::normalize(glm::vec3(back_m.x, 0.0F, back_m.z));
  }
  --ticks_;
  input_.jump = random_.below(2 * tick_rate_hz_) == 0;
  return input_;
}

}  // namespace scree
