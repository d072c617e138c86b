// Whether the simulation's thread goes on: it beats before each tick, and other threads look when it did so
// last. Time is an argument, seconds. beat() is for the simulation's thread, silent_s() for any,
// check() for one.
#pragma once

#include <atomic>
#include <optional>
#include <string>

namespace scree {

class Heartbeat {
 public:
  /// `silent_seconds_max`: longer silences count as a thread that stands still.
  Heartbeat(double now_s, double silent_seconds_max) : silent_max_s_(silent_seconds_max), last_s_(now_s) {}

  void beat(double now_s) { last_s_.store(now_s, std::memory_order_relaxed); }
  double silent_s(double now_s) const { return now_s - last_s_.load(std::memory_order_relaxed); }
  bool stands_still(double now_s) const { return silent_s(now_s) > silent_max_s_; }

  /// A line for the log, when the thread begins to stand still, every limits::still_line_seconds after that,
  /// and when it goes on.
  std::optional<std::string> check(double now_s);

 private:
  const double silent_max_s_;
  std::atomic<double> last_s_;
  double told_s_ = 0.0;  ///< silence in the last line; 0: the thread goes on
  double worst_s_ = 0.0;
};

}  // namespace scree
