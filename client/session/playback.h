// Messages that have come and are not applied yet. With a clock that runs a little behind the server, it
// smooths network jitter: a frame waits until the clock reaches its tick.
//
// Order is kept: a message after a frame waits with it. Time is an argument: seconds of
// std::chrono::steady_clock, never backwards. Not thread-safe.
#pragma once

#include <deque>
#include <optional>

#include "client/connection/server_channel.h"

namespace scree {

class Playback {
 public:
  /// Begins anew. Until the first frame, everything passes at once.
  void start(const WelcomeMessage& welcome);
  void push(Received received);
  /// The next message that is due, in order; nothing when none is.
  std::optional<Received> pop_next(double now_s);
  /// The next message, due or not.
  std::optional<Received> take_first();
  bool empty() const { return waiting_.empty(); }
  /// The tick (with its fraction) at which pieces are drawn now. It is behind the frames that pop_next()
  /// returned by the interval of the transforms, so that the poses before and after it are known.
  double draw_tick(double now_s);

 private:
  void note_arrival(Tick tick, double now_s);
  double clock(double now_s);

  double rate_hz_ = 60.0;
  double transform_ticks_ = 3.0;
  std::deque<Received> waiting_;
  std::optional<double> start_s_;  ///< local time of tick 0, as the least delayed frames tell it
  bool overfull_ = false;          ///< all that waits is due
  Tick newest_ = 0;
  double clock_ = 0.0;  ///< never runs backwards, but for a new start
};

}  // namespace scree
