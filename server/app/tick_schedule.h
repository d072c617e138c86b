// When ticks are due. A simulation that is late begins its next ticks at once until it has caught up, up to
// limits::catch_up_ticks_max; the real time beyond is lost. Time comes in as an argument. Not thread-safe.
#pragma once

#include <chrono>
#include <cstdint>

#include "server/app/limits.h"
#include "shared/base/check.h"

namespace scree {

class TickSchedule {
 public:
  using Clock = std::chrono::steady_clock;

  TickSchedule(Clock::time_point first, Clock::duration period) : due_(first), period_(period) {}

  /// When the next tick is to begin.
  Clock::time_point due() const { return due_; }

  struct Delay {
    bool late = false;        ///< the next tick should have begun already
    uint64_t lost_ticks = 0;  ///< of real time, that are not made up for
  };

  /// A tick has ended.
  Delay tick_ended(Clock::time_point now) {
    due_ += period_;
    if (now <= due_) return {};
    const auto behind = (now - due_) / period_;
    if (behind <= limits::catch_up_ticks_max) return {true, 0};
    due_ += period_ * behind;
    CHECK(due_ + period_ > now);
    return {true, static_cast<uint64_t>(behind)};
  }

 private:
  Clock::time_point due_;
  Clock::duration period_;
};

}  // namespace scree
