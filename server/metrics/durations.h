// A distribution of durations in bounded memory: 2 % wide bins from 1 µs to 100 s.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "shared/base/check.h"

namespace scree {

class Durations {
 public:
  /// `times`: so many durations of this length.
  void add(double ms, uint64_t times = 1) {
    CHECK(ms >= 0.0);
    bins_[bin_of(ms)] += times;
    count_ += times;
    sum_ms_ += ms * static_cast<double>(times);
    worst_ms_ = std::max(worst_ms_, ms);
  }
  uint64_t count() const { return count_; }
  double sum_ms() const { return sum_ms_; }
  /// How many were as long at most; those within 2 % of it may count on either side.
  uint64_t count_up_to(double ms) const {
    uint64_t below = 0;
    for (size_t bin = 0; bin <= bin_of(ms); ++bin) below += bins_[bin];
    return below;
  }
  double worst_ms() const { return worst_ms_; }
  /// Within 1 %; 0 when nothing was added. `share` in 0 … 1.
  double quantile_ms(double share) const {
    CHECK(share >= 0.0 && share <= 1.0);
    if (count_ == 0) return 0.0;
    const auto wanted = static_cast<uint64_t>(std::ceil(share * static_cast<double>(count_)));
    uint64_t below = 0;
    for (size_t bin = 0; bin < bins_.size(); ++bin) {
      below += bins_[bin];
      if (below >= std::max<uint64_t>(1, wanted)) return std::min(worst_ms_, middle_ms(bin));
    }
    return worst_ms_;
  }

 private:
  static constexpr double least_ms = 0.001;
  static constexpr double bins_per_e = 50.0;
  static size_t bin_of(double ms) {
    if (!(ms > least_ms)) return 0;
    return std::min(bins - 1, 1 + static_cast<size_t>(std::log(ms / least_ms) * bins_per_e));
  }
  static double middle_ms(size_t bin) {
    return bin == 0 ? 0.0 : least_ms * std::exp((static_cast<double>(bin) - 0.5) / bins_per_e);
  }
  static constexpr size_t bins = 924;

  std::array<uint64_t, bins> bins_{};
  uint64_t count_ = 0;
  double sum_ms_ = 0.0;
  double worst_ms_ = 0.0;
};

}  // namespace scree
