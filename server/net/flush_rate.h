// Decides with which tick the messages that are queued are sent: with every one as long as that is quick.
// When it takes much of a tick, or the network thread lags, those of several ticks go together, by one write
// for each session. Not thread-safe; no clock.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "server/net/limits.h"

namespace scree {

class FlushRate {
 public:
  explicit FlushRate(uint32_t tick_rate_hz) : tick_rate_hz_(tick_rate_hz) {}

  /// Notes that a tick's messages are queued, and returns whether all are to be sent now. `more`: the next
  /// tick's are queued at once.
  bool due(bool more) {
    ++queued_;
    return queued_ >= limits::ticks_per_flush_max || (!more && queued_ >= ticks());
  }
  /// Notes that all was sent, which took so long.
  void flushed(double seconds) {
    queued_ = 0;
    constexpr double newest = 0.125;  // of the average, so that one slow write changes little
    average_s_ += newest * (seconds - average_s_);
  }

 private:
  double ticks() const { return std::ceil(average_s_ * tick_rate_hz_ / limits::flush_share_max); }

  double tick_rate_hz_;
  double average_s_ = 0.0;
  uint32_t queued_ = 0;
};

}  // namespace scree
