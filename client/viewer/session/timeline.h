// Where a replay stands, what happened when, and what this person wants of it. Wishes go to the server one
// after the other; of moves that wait for one under way the last counts, so that dragging asks for no more
// than the server can show. Time is an argument (seconds). Not thread-safe.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "client/viewer/input/actions.h"
#include "proto/messages.h"

namespace scree {

class Timeline {
 public:
  /// With another server, or again: nothing is known yet.
  void begin(double tick_rate_hz);
  /// Whether the moment is another one than playing would have come to.
  bool apply(const PlaybackMessage& playback, double now_s);
  void apply(const MarksMessage& news) { apply_news(marks_, news); }
  /// The server has refused a wish: what waited for its end goes on.
  void refused() { under_way_.reset(); }

  /// Whether a replay has said where it stands; all that follows needs it.
  bool is_known() const { return playback_.has_value(); }
  const PlaybackMessage& playback() const { return *playback_; }
  const MarksMessage& marks() const { return marks_; }
  double tick_rate_hz() const { return tick_rate_hz_; }
  bool may_control() const { return playback_ && playback_->refusal.empty(); }
  /// The tick to show as the moment: where this person wants it to be, if the server is not there yet.
  double moment(double now_s) const;

  /// Wants the moment there, within the recording. Does nothing for who may not control it, like ask().
  void seek(double tick);
  void ask(const ControlReplayRequest& wish);
  /// What the action wants of the replay; nothing if it concerns others.
  void act(Action action);
  /// The next wish to be sent. Call again until there is none.
  std::optional<ControlReplayRequest> pop_due(double now_s);

 private:
  struct UnderWay {
    ControlReplayRequest wish;
    uint64_t heeded = 0;  ///< by the server, once it is done
    double sent_s = 0.0;
  };
  float other_speed(bool faster) const;
  /// As the server said, and by playing since.
  double played_to(double now_s) const;

  double tick_rate_hz_ = 60.0;
  std::optional<PlaybackMessage> playback_;  ///< the server's last, with own wishes for play and speed
  double told_s_ = 0.0;
  uint64_t heeded_ = 0;  ///< that the server will have heeded once all that was sent is done
  MarksMessage marks_;
  std::deque<ControlReplayRequest> waiting_;
  std::optional<UnderWay> under_way_;  ///< the last move that was sent
};

/// "1:02:03", of a tick; hours if there are any.
std::string time_text(double tick, double tick_rate_hz);

}  // namespace scree
