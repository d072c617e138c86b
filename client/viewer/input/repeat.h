// A button that acts when it goes down, and again and again while it is held. No clock: time is an argument,
// in seconds.
#pragma once

namespace scree {

class Repeat {
 public:
  /// How many times it acts in this frame: once for each of the `presses` since the last one; else once when
  /// it is still `held` after a press and `interval_s` has passed since it acted last.
  int step(int presses, bool held, double interval_s, double now_s) {
    const bool due = presses == 0 && held && pressed_ && now_s >= last_s_ + interval_s;
    const int times = due ? 1 : presses;
    if (times > 0) last_s_ = now_s;
    pressed_ = held && (pressed_ || presses > 0);
    return times;
  }

 private:
  bool pressed_ = false;  ///< and held since
  double last_s_ = 0.0;
};

}  // namespace scree
