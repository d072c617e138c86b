// When a write that failed is tried again: after pauses that grow, so that a disk in trouble is left alone,
// and that are bounded, so that a disk that works again is soon used. Time is an argument (seconds of the
// steady clock). Not thread-safe.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "server/store/limits.h"

namespace scree {

/// How it stands with a file that the server writes: for its log, its status, and its health.
struct StoreHealth {
  std::optional<std::string> because;  ///< why the last try failed; nothing: all that was due is written
  uint64_t since_unix_ms = 0;          ///< the first failure since it was well, or 0
  /// Given up for good since the start: ticks of a recording, or lines of a log. A world gives nothing up
  /// before the server ends.
  uint64_t lost = 0;

  bool ok() const { return !because.has_value(); }
};

class RetryPause {
 public:
  /// A try has failed. `is_held`: another program holds the file, which it mostly does for seconds.
  void failed(double now_s, bool is_held) {
    const bool is_new = now_s - last_failure_s_ > 2.0 * limits::retry_pause_max_s;
    const double most_s = is_held ? limits::retry_held_max_s : limits::retry_pause_max_s;
    pause_s_ = is_new ? limits::retry_pause_min_s : std::min(2.0 * pause_s_, most_s);
    last_failure_s_ = now_s;
    next_s_ = now_s + pause_s_;
  }
  /// The time before which nothing is tried.
  double next_s() const { return next_s_; }
  bool is_over(double now_s) const { return now_s >= next_s_; }

 private:
  double pause_s_ = limits::retry_pause_min_s;
  double last_failure_s_ = -1.0e9;
  double next_s_ = 0.0;
};

}  // namespace scree
