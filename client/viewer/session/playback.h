// Smooths network jitter: delays each message until a clock that runs a little behind the server reaches it.
//
// Order is kept: a message after a frame waits with it. Time is an argument (seconds, any origin, never
// backwards). Not thread-safe.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "proto/messages.h"

namespace scree {

class Playback {
 public:
  /// Until the welcome, everything passes at once.
  void start(const WelcomeMessage& welcome);
  void push(ServerMessage message, double now_s);
  /// The next message that is due, in order; nothing when none is.
  std::optional<ServerMessage> take_next(double now_s);
  /// All of them.
  std::vector<ServerMessage> take_due(double now_s);
  /// The tick (with its fraction) at which pieces are drawn now. It is behind the frames that take_due()
  /// returned by the interval of the transforms, so that the poses before and after it are known.
  double draw_tick(double now_s);

 private:
  void note_arrival(Tick tick, double now_s);
  double clock(double now_s);

  double rate_hz_ = 60.0;
  double transform_ticks_ = 3.0;
  std::deque<ServerMessage> waiting_;
  std::optional<double> start_s_;  ///< local time of tick 0, as the least delayed frames tell it
  bool overfull_ = false;          ///< all that waits is due
  Tick newest_ = 0;
  double clock_ = 0.0;  ///< never runs backwards, but for a new start
};

}  // namespace scree
