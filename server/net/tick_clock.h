// How long the ticks of the last second took, each of their stages, and what they had to do, for the status
// that people read.
#pragma once

#include <algorithm>
#include <array>
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
    if (times_.empty()) return 0.0F;
    std::vector<StageTimes> sorted = times_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle, {}, &StageTimes::total_ms);
    return static_cast<float>(middle->total_ms);
  }
  float worst_ms() const {
    if (times_.empty()) return 0.0F;
    return static_cast<float>(std::ranges::max_element(times_, {}, &StageTimes::total_ms)->total_ms);
  }
  /// Means, in the order of stage_names.
  std::array<float, stage_names.size()> stages_ms() const {
    constexpr std::array stages{&StageTimes::carve_ms,   &StageTimes::spawn_ms,  &StageTimes::bodies_ms,
                                &StageTimes::impacts_ms, &StageTimes::rest_ms,   &StageTimes::recombine_ms,
                                &StageTimes::islands_ms, &StageTimes::publish_ms};
    static_assert(stages.size() == stage_names.size());
    std::array<float, stages.size()> means{};
    for (size_t i = 0; i < stages.size() && !times_.empty(); ++i) {
      double sum = 0.0;
      for (const StageTimes& times : times_) sum += times.*stages[i];
      means[i] = static_cast<float>(sum / static_cast<double>(times_.size()));
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
      sum.dents_left_out += work.dents_left_out;
      sum.ticks_cut_short += work.cut_short() ? 1 : 0;
      sum.ticks_merging_sooner += work.merging_sooner ? 1 : 0;
      sum.supports_put_off = std::max(sum.supports_put_off, work.supports_put_off);
      sum.islands_put_off = std::max(sum.islands_put_off, work.islands_put_off);
      sum.islands_too_large += work.islands_too_large;
    }
    return sum;
  }

 private:
  size_t window_;
  size_t next_ = 0;  ///< the oldest, once the window is full
  std::vector<StageTimes> times_;
  std::vector<TickWork> work_;  ///< of the same ticks
};

}  // namespace scree
