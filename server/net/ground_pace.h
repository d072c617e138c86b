// How much ground the network thread generates in a tick: as much as its idle time allows. It rises slowly
// while ticks leave time, and is halved when they do not, or when the next tick waits already. Times are
// measured, so a slow or busy machine generates less. No clock. Not thread-safe.
#pragma once

#include <algorithm>

#include "server/net/limits.h"
#include "server/publish/limits.h"

namespace scree {

class GroundPace {
 public:
  /// As of limits::ground_work_min.
  int work_per_tick() const { return work_; }

  /// A tick of so many seconds took the network thread so long; `lags`: the next one waits for it.
  void ticked(double busy_s, double tick_s, bool lags) {
    if (lags || busy_s > limits::tick_share_busy * tick_s)
      work_ = std::max(limits::ground_work_min, work_ / 2);
    else if (busy_s < limits::tick_share_idle * tick_s)
      work_ = std::min(limits::ground_work_max, work_ + 1);
  }

 private:
  int work_ = limits::ground_work_min;
};

}  // namespace scree
