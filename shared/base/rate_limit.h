// A token bucket: a number of tokens a second, and a larger number at once. Time is an argument (seconds).
#pragma once

#include <algorithm>
#include <cmath>

#include "shared/base/check.h"

namespace scree {

class RateLimit {
 public:
  /// The burst holds at least one token.
  RateLimit(double per_second, double burst) : per_second_(per_second), burst_(burst), tokens_(burst) {
    CHECK(per_second >= 0.0 && burst >= 1.0);
  }

  /// Takes tokens; false when there are not as many.
  [[nodiscard]] bool try_spend(double now_s, double tokens = 1.0) {
    CHECK(std::isfinite(now_s) && tokens >= 0.0);
    tokens_ = std::min(burst_, tokens_ + std::max(0.0, now_s - last_s_) * per_second_);
    last_s_ = now_s;
    if (tokens_ < tokens) return false;
    tokens_ -= tokens;
    return true;
  }

  /// From now on. What has been saved up stays, as far as the new burst goes.
  void change(double per_second, double burst) {
    per_second_ = per_second;
    burst_ = burst;
    tokens_ = std::min(tokens_, burst);
  }

 private:
  double per_second_;
  double burst_;
  double tokens_;
  double last_s_ = 0.0;
};

}  // namespace scree
