// The last few seconds of a figure, for a graph.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace scree {

class History {
 public:
  static constexpr size_t length = 240;  ///< frames: four seconds at 60 Hz

  void add(float value) {
    values_[next_] = value;
    next_ = (next_ + 1) % length;
    count_ = std::min(count_ + 1, length);
  }
  /// Oldest first from offset() on, round the ring; zeroes before the first.
  const float* data() const { return values_.data(); }
  int offset() const { return static_cast<int>(next_); }
  float last() const { return values_[(next_ + length - 1) % length]; }
  float worst() const { return *std::ranges::max_element(values_); }
  float mean() const {
    float sum = 0.0F;
    for (const float value : values_) sum += value;
    return count_ == 0 ? 0.0F : sum / static_cast<float>(count_);
  }

 private:
  std::array<float, length> values_{};
  size_t next_ = 0;
  size_t count_ = 0;
};

}  // namespace scree
