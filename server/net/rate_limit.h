// A token bucket: so many a second, and a burst of so many at once. Time comes in as an argument (seconds).
#pragma once

#include <algorithm>

namespace scree {

class RateLimit {
 public:
  RateLimit(double per_second, double burst) : per_second_(per_second), burst_(burst), tokens_(burst) {}

  /// Takes one, if there is one.
  [[nodiscard]] bool take(double now_s) {
    tokens_ = std::min(burst_, tokens_ + std::max(0.0, now_s - last_s_) * per_second_);
    last_s_ = now_s;
    if (tokens_ < 1.0) return false;
    tokens_ -= 1.0;
    return true;
  }

 private:
  double per_second_;
  double burst_;
  double tokens_;
  double last_s_ = 0.0;
};

}  // namespace scree
