// How long the ticks of the last second took, for the status that people read.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace scree {

class TickClock {
 public:
  explicit TickClock(uint32_t ticks_per_second) : window_(std::max(1U, ticks_per_second)) {}

  void add(double tick_ms) {
    if (times_ms_.size() < window_) {
      times_ms_.push_back(tick_ms);
      return;
    }
    times_ms_[next_] = tick_ms;
    next_ = (next_ + 1) % window_;
  }
  float median_ms() const {
    if (times_ms_.empty()) return 0.0F;
    std::vector<double> sorted = times_ms_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    return static_cast<float>(*middle);
  }
  float worst_ms() const {
    return times_ms_.empty() ? 0.0F : static_cast<float>(std::ranges::max(times_ms_));
  }

 private:
  size_t window_;
  size_t next_ = 0;  ///< the oldest, once the window is full
  std::vector<double> times_ms_;
};

}  // namespace scree
