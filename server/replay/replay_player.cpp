#include "server/replay/replay_player.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr double ms_per_s = 1000.0;

}  // namespace

ReplayPlayer::ReplayPlayer(std::unique_ptr<ReplaySource> source, const PlayerOptions& options)
    : source_(std::move(source)),
      options_(options),
      from_(source_->tick()),
      first_known_(source_->first_tick()),
      speed_(options.speed),
      grows_(!source_->is_ended()) {
  CHECK(speed_ != 0.0F && options_.ticks_per_transform > 0);
  source_->let_go();
}

Result<void> ReplayPlayer::request(const ControlReplayRequest& wish) {
  const std::scoped_lock lock(mutex_);
  if (wishes_.size() >= limits::replay_wishes_max)
    return fail("too many wishes wait for the replay's next tick (limits.replay_wishes_max)");
  wishes_.push_back(wish);
  return {};
}

PlaybackMessage ReplayPlayer::state() const {
  return {source_->tick(), source_->first_tick(), source_->last_tick(), speed_, playing_, heeded_, grows_};
}

Tick ReplayPlayer::within(double tick) const {
  return static_cast<Tick>(std::clamp(tick, static_cast<double>(source_->first_tick()),
                                      static_cast<double>(source_->last_tick())));
}

/// Steps count from where a jump that waits ends.
Result<Tick> ReplayPlayer::target_of(const ControlReplayRequest& wish) {
  const Tick here = target_.value_or(source_->tick());
  const auto value = static_cast<double>(wish.value);
  switch (wish.move) {
    case ReplayMove::stay:
      return here;
    case ReplayMove::to_tick:
      return within(value);
    case ReplayMove::by_ticks:
      return within(static_cast<double>(here) + value);
    case ReplayMove::to_time:
      return within(std::round(value / ms_per_s * header().world.tick_rate_hz));
    case ReplayMove::next_event:
    case ReplayMove::previous_event: {
      const bool on = wish.move == ReplayMove::next_event;
      const auto event = on ? source_->next_event(here) : source_->previous_event(here);
      TRY(event);
      return event->value_or(here);
    }
  }
  return here;
}

Result<void> ReplayPlayer::heed(const ControlReplayRequest& wish) {
  if (wish.speed != 0.0F) speed_ = wish.speed;
  if (wish.play != ReplayPlay::as_it_is) playing_ = wish.play == ReplayPlay::play;
  if (wish.move == ReplayMove::stay) {
    ++heeded_;
    return {};
  }
  const auto to = TRY(target_of(wish));
  const Tick first = source_->first_tick();
  if (wish.move == ReplayMove::to_tick && first > first_known_ && wish.value < static_cast<int64_t>(first))
    tell_dropped(static_cast<Tick>(std::max<int64_t>(wish.value, 0)), " is asked for", told_asked_);
  target_ = to;
  ++moves_waiting_;
  return {};
}

bool ReplayPlayer::at_border() const {
  return source_->tick() == (speed_ > 0.0F ? source_->last_tick() : source_->first_tick());
}

Tick ReplayPlayer::spend_credit() {
  const double whole = std::floor(credit_);
  credit_ -= whole;
  return static_cast<Tick>(whole);
}

/// Backwards as jumps: what is due since the last one.
Result<std::shared_ptr<const TickDelta>> ReplayPlayer::move() {
  if (!begun_) return source_->next(1);
  if (target_ && may_jump()) {
    credit_ = 0.0;
    heeded_ += std::exchange(moves_waiting_, 0);
    return source_->jump(within(static_cast<double>(*std::exchange(target_, std::nullopt))));
  }
  if (target_ || !playing_ || at_border()) return source_->same();
  credit_ += std::abs(static_cast<double>(speed_));
  const bool back = speed_ < 0.0F;
  if (credit_ < 1.0 || (back && !may_jump())) return source_->same();
  const Tick count = spend_credit();
  return back ? source_->jump(within(static_cast<double>(source_->tick()) - static_cast<double>(count)))
              : source_->next(count);
}

Result<void> ReplayPlayer::refresh_source() {
  if (source_->is_ended()) {
    grows_ = false;
    return {};
  }
  const Tick before = source_->last_tick();
  TRY(source_->refresh());
  quiet_ticks_ = source_->last_tick() > before ? 0 : quiet_ticks_ + 1;
  grows_ = !source_->is_ended() &&
           static_cast<double>(quiet_ticks_) < limits::quiet_s_max * header().world.tick_rate_hz;
  return source_->tick() < source_->first_tick() ? leave_dropped(before != 0) : Result<void>();
}

/// Once for each place where it begins: a person who drags a bar asks often.
void ReplayPlayer::tell_dropped(Tick tick, const char* what, std::optional<Tick>& told) {
  const Tick first = source_->first_tick();
  if (!options_.tell || std::exchange(told, first) == first) return;
  options_.tell(fmt::format(
      "tick {}{}, which the recording's ring has dropped: the replay goes on at tick {}, where it begins now",
      tick, what, first));
}

/// Its first tick has a keyframe. The jump waits for a tick with poses.
Result<void> ReplayPlayer::leave_dropped(bool was_there) {
  if (target_ && *target_ >= source_->first_tick()) return {};
  if (was_there) tell_dropped(source_->tick(), " is shown", told_shown_);
  if (!begun_) return source_->seek(source_->first_tick());
  target_ = source_->first_tick();
  return {};
}

Result<void> ReplayPlayer::add_company(TickDelta& delta) {
  auto marks = source_->marks();
  TRY(marks);
  delta.marks = std::move(*marks);
  if (number_ % options_.ticks_per_transform != 0) return {};
  auto cursors = source_->cursors();
  TRY(cursors);
  if (cursors_ == nullptr || cursors_->cursors != *cursors)
    cursors_ = std::make_shared<RecordedCursorsMessage>(RecordedCursorsMessage{std::move(*cursors)});
  delta.cursors = cursors_;
  return {};
}

Result<std::shared_ptr<const TickDelta>> ReplayPlayer::next() {
  TRY(refresh_source());
  {
    std::vector<ControlReplayRequest> wishes;
    {
      const std::scoped_lock lock(mutex_);
      wishes.swap(wishes_);
    }
    for (const ControlReplayRequest& wish : wishes) TRY(heed(wish));
  }
  if (begun_ && playing_ && !target_ && at_border() && !waits_for_more()) {
    const bool at_end = speed_ > 0.0F;
    if (at_end && options_.at_end == AtEnd::end) return nullptr;
    if (at_end && options_.at_end == AtEnd::loop)
      target_ = from_;
    else
      playing_ = false;
  }
  auto moved = move();
  if (!moved) return moved;
  if (*moved == nullptr) return nullptr;  // nothing was recorded after where it begins
  auto delta = std::make_shared<TickDelta>(**moved);
  number_ = begun_ ? number_ + 1 : std::max<Tick>(delta->tick, 1);
  begun_ = true;
  delta->tick = number_;
  delta->playback = state();
  TRY(add_company(*delta));
  source_->let_go();
  return delta;
}

}  // namespace scree
