// A moment of a recording, as people say it.
#pragma once

#include <string>

#include "shared/base/ids.h"
#include "shared/base/result.h"

namespace scree {

/// A tick, as "5400", or a time since tick 0, as "90s", "1.5m", "2h", "1:30" or "1:02:03.5".
struct TickOrTime {
  double value = 0.0;  ///< at most 10^15 of either
  bool is_seconds = false;

  double tick(uint32_t tick_rate_hz) const { return is_seconds ? value * tick_rate_hz : value; }
  Tick nearest_tick(uint32_t tick_rate_hz) const;
};

Result<TickOrTime> parse_tick_or_time(const std::string& text);

}  // namespace scree
