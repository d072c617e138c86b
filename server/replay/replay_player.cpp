#include "server/replay/replay_player.h"

#include <algorithm>
#include <cmath>
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
      speed_(options.speed),
      grows_(!source_->is_ended()) {
  CHECK(speed_ != 0.0F && options_.ticks_per_transform > 0);
}

Result<void> ReplayPlayer::take(const ControlReplay& wish) {
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
Result<Tick> ReplayPlayer::target_of(const ControlReplay& wish) {
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
      if (!event) return tl::unexpected(event.error());
      return event->value_or(here);
    }
  }
  return here;
}

Result<void> ReplayPlayer::heed(const ControlReplay& wish) {
  if (wish.speed != 0.0F) speed_ = wish.speed;
  if (wish.play != ReplayPlay::as_it_is) playing_ = wish.play == ReplayPlay::play;
  if (wish.move == ReplayMove::stay) {
    ++heeded_;
    return {};
  }
  const auto to = target_of(wish);
  if (!to) return tl::unexpected(to.error());
  target_ = *to;
  ++moves_waiting_;
  return {};
}

bool ReplayPlayer::at_border() const {
  return source_->tick() == (speed_ > 0.0F ? source_->last_tick() : source_->first_tick());
}

Tick ReplayPlayer::take_due() {
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
    return source_->jump(*std::exchange(target_, std::nullopt));
  }
  if (target_ || !playing_ || at_border()) return source_->same();
  credit_ += std::abs(static_cast<double>(speed_));
  const bool back = speed_ < 0.0F;
  if (credit_ < 1.0 || (back && !may_jump())) return source_->same();
  const Tick count = take_due();
  return back ? source_->jump(within(static_cast<double>(source_->tick()) - static_cast<double>(count)))
              : source_->next(count);
}

Result<void> ReplayPlayer::look() {
  if (source_->is_ended()) {
    grows_ = false;
    return {};
  }
  const Tick before = source_->last_tick();
  if (auto looked = source_->look_again(); !looked) return looked;
  quiet_looks_ = source_->last_tick() > before ? 0 : std::min(quiet_looks_ + 1, limits::quiet_looks_max);
  grows_ = !source_->is_ended() && quiet_looks_ < limits::quiet_looks_max;
  return {};
}

Result<void> ReplayPlayer::add_company(TickDelta& delta) {
  auto marks = source_->marks();
  if (!marks) return tl::unexpected(marks.error());
  delta.marks = std::move(*marks);
  if (number_ % options_.ticks_per_transform != 0) return {};
  auto cursors = source_->cursors();
  if (!cursors) return tl::unexpected(cursors.error());
  if (cursors_ == nullptr || cursors_->cursors != *cursors)
    cursors_ = std::make_shared<RecordedCursorsMessage>(RecordedCursorsMessage{std::move(*cursors)});
  delta.cursors = cursors_;
  return {};
}

Result<std::shared_ptr<const TickDelta>> ReplayPlayer::next() {
  {
    std::vector<ControlReplay> wishes;
    {
      const std::scoped_lock lock(mutex_);
      wishes.swap(wishes_);
    }
    for (const ControlReplay& wish : wishes)
      if (auto heeded = heed(wish); !heeded) return tl::unexpected(heeded.error());
  }
  if (begun_ && number_ % std::max(header().world.tick_rate_hz / 2, 1U) == 0)
    if (auto looked = look(); !looked) return tl::unexpected(looked.error());
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
  number_ = begun_ ? number_ + 1 : delta->tick;
  begun_ = true;
  delta->tick = number_;
  delta->playback = state();
  if (auto added = add_company(*delta); !added) return tl::unexpected(added.error());
  return delta;
}

}  // namespace scree
