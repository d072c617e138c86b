#include "server/publish/replay_news.h"

#include "proto/codec.h"
#include "shared/base/check.h"

namespace scree {

void ReplayNews::serve(const TickDelta& delta, bool in_full, bool reads_along, Outlet& outlet,
                       ServedPart& part) {
  CHECK(delta.playback.has_value());
  send_playback(*delta.playback, in_full, outlet, part);
  if (!reads_along) return;
  if (delta.marks != nullptr && delta.marks != marks_) {
    outlet.send(share(marks_ ? news_since(*marks_, *delta.marks) : *delta.marks), part);
    marks_ = delta.marks;
  }
  if (delta.cursors != nullptr && delta.cursors != cursors_) {
    const bool is_news = cursors_ || !delta.cursors->cursors.empty();
    if (is_news) outlet.send(share(*delta.cursors), part);
    cursors_ = delta.cursors;
  }
}

/// The moment's own pace is no news.
void ReplayNews::send_playback(const PlaybackMessage& now, bool in_full, Outlet& outlet, ServedPart& part) {
  PlaybackMessage told = now;
  told.refusal = control_refusal_;
  if (playback_ && !in_full) {
    PlaybackMessage known = *playback_;
    known.moment = told.moment;
    known.last = told.last;
    if (known == told) return;
  }
  playback_ = told;
  outlet.send(share(told), part);
}

}  // namespace scree
