// How long the ticks of the last second took, each of their stages, and what they had to do, for the status
// that people read.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "proto/messages.h"
#include "server/world/tick_delta.h"

namespace scree {

class TickClock {
 public:
  explicit TickClock(uint32_t ticks_per_second) : window_(std::max(1U, ticks_per_second)) {}

  void add(const StageTimes& times, const TickWork& work) {
    if (times_.size() < window_) {
      times_.push_back(times);
      work_.push_back(work);
      return;
    }
    times_[next_] = times;
    work_[next_] = work;
    next_ = (next_ + 1) % window_;
  }
  float median_ms() const {
    std::vector<double> totals = totals_ms();
    if (totals.empty()) return 0.0F;
    const auto middle = totals.begin() + static_cast<std::ptrdiff_t>(totals.size() / 2);
    std::ranges::nth_element(totals, middle);
    return static_cast<float>(*middle);
  }
  float worst_ms() const {
    const std::vector<double> totals = totals_ms();
    return totals.empty() ? 0.0F : static_cast<float>(std::ranges::max(totals));
  }
  /// Means, in the order of tick_stages.
  std::vector<StageTime> stages() const {
    std::vector<StageTime> means;
    for (const TickStageRow& row : tick_stages) {
      double sum = 0.0;
      for (const StageTimes& times : times_) sum += times[row.stage];
      const double count = std::max<double>(1.0, static_cast<double>(times_.size()));
      means.push_back({std::string(row.name), static_cast<float>(sum / count)});
    }
    return means;
  }
  WorkStatus work() const {
    WorkStatus sum;
    for (const TickWork& work : work_) {
      sum.budget_us = work.budget_us;
      sum.worst_us = std::max(sum.worst_us, work.estimate_us);
      sum.requests_waiting = std::max(sum.requests_waiting, work.requests_waiting);
      sum.merges_put_off = std::max(sum.merges_put_off, work.merges_put_off);
      sum.breaks_left_out += work.breaks_left_out;
      sum.dents_left_out += work.dents_left_out + work.blows_left_out;
      sum.ticks_cut_short += work.has_leftovers() ? 1 : 0;
      sum.ticks_merging_sooner += work.merging_sooner ? 1 : 0;
      sum.supports_put_off = std::max(sum.supports_put_off, work.supports_put_off);
      sum.islands_put_off = std::max(sum.islands_put_off, work.islands_put_off);
      sum.islands_too_large += work.islands_too_large;
    }
    return sum;
  }

 private:
  std::vector<double> totals_ms() const {
    std::vector<double> totals;
    for (const StageTimes& times : times_) totals.push_back(times.total_ms());
    return totals;
  }

  size_t window_;
  size_t next_ = 0;  ///< the oldest, once the window is full
  std::vector<StageTimes> times_;
  std::vector<TickWork> work_;  ///< of the same ticks
};

}  // namespace scree
