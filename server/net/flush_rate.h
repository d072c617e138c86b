// Decides which sessions' queued messages are sent with a tick: all, as long as that is quick. When it takes
// much of a tick, each session's are sent with every second tick, or third, or fourth, those of several ticks
// by one write. The sessions take turns, so that each tick has as many writes as the others. A frame waits
// for its session's turn, but not for the writes to all the others. Not thread-safe; no clock.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "server/net/limits.h"

namespace scree {

class FlushRate {
 public:
  explicit FlushRate(uint32_t tick_rate_hz) : tick_rate_hz_(tick_rate_hz) {}

  /// How many of the sessions with queued messages, `waiting` in all, are sent them now, the longest waiting
  /// first; at least those that have `waited` for limits::ticks_per_flush_max ticks. `more`: the next tick's
  /// messages are queued at once, so the others wait for these.
  size_t due(size_t waiting, size_t waited, bool more) const {
    if (more) return waited;
    const size_t turns = turns_of(waiting);
    return std::max(waited, (waiting + turns - 1) / turns);
  }
  /// Notes that so many sessions were sent their messages, which took so long.
  void flushed(size_t sessions, double seconds) {
    if (sessions == 0) return;
    constexpr double newest = 0.125;  // of the average, so that one slow write changes little
    session_s_ += newest * (seconds / static_cast<double>(sessions) - session_s_);
  }

 private:
  /// Ticks in which all are sent their messages once.
  size_t turns_of(size_t waiting) const {
    const double all_ticks = session_s_ * static_cast<double>(waiting) * tick_rate_hz_;
    const double turns = std::ceil(all_ticks / limits::flush_share_max);
    return static_cast<size_t>(std::clamp(turns, 1.0, static_cast<double>(limits::ticks_per_flush_max)));
  }

  double tick_rate_hz_;
  double session_s_ = 0.0;  ///< that one session's write takes, on average
};

}  // namespace scree
