// How fast the world's time goes beside the clock's, as the frames that arrive tell it. Time is an argument
// (seconds of any clock). Not thread-safe.
#pragma once

#include <cstdint>
#include <deque>

#include "shared/base/ids.h"

namespace scree {

class Pace {
 public:
  /// Seconds over which the pace is taken.
  static constexpr double window_s = 3.0;

  /// Begins anew, with a world of that rate (over 0).
  void start(double tick_rate_hz);
  /// A frame of that tick arrived.
  void note(Tick tick, double now_s);
  /// Ticks that went by in the window, as part of those of real time; 1 before it is known.
  double factor() const;
  /// Ticks by which the world is behind real time since the start. A late frame is none: the least late one
  /// of the window counts, beside the least late one of the first window.
  uint64_t lost_ticks() const;

 private:
  struct Arrival {
    double at_s = 0.0;
    Tick tick = 0;
    double late_s = 0.0;  ///< arrival less the tick's own time
  };
  double least_late_s() const;

  double rate_hz_ = 60.0;
  std::deque<Arrival> arrivals_;  ///< of the window; the oldest may be older by one
  double begun_s_ = 0.0;
  double least_late_at_first_s_ = 0.0;
};

}  // namespace scree
