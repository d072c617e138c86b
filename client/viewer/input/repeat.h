// A button that acts when it goes down, and again and again while it is held. No clock: time is an argument,
// in seconds.
#pragma once

#include <algorithm>

namespace scree {

class Repeat {
 public:
  /// From a press to the first repetition, as keyboards have it: on a slow machine a short press looks long.
  static constexpr double hold_s = 0.5;

  /// How many times it acts in this frame: once for each of the `presses` since the last one; else once when
  /// it is still `held` after a press and `interval_s` has passed since it acted last, the first time hold_s.
  int step(int presses, bool held, double interval_s, double now_s) {
    const double wait_s = repeats_ ? interval_s : std::max(interval_s, hold_s);
    const bool due = presses == 0 && held && pressed_ && now_s >= last_s_ + wait_s;
    const int times = due ? 1 : presses;
    if (times > 0) {
      last_s_ = now_s;
      repeats_ = due;
    }
    pressed_ = held && (pressed_ || presses > 0);
    return times;
  }

 private:
  bool pressed_ = false;  ///< and held since
  bool repeats_ = false;  ///< it has acted again since the press
  double last_s_ = 0.0;
};

}  // namespace scree
