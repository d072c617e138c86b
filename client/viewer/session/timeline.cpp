#include "client/viewer/session/timeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "client/viewer/base/limits.h"

namespace scree {
namespace {

constexpr double jump_least_s = 0.5;
constexpr std::array speeds{0.1F, 0.25F, 0.5F, 1.0F, 2.0F, 4.0F, 8.0F, 16.0F};

bool is_seek(const ControlReplayRequest& wish) {
  return wish.move == ReplayMove::to_tick;
}

}  // namespace

void Timeline::begin(double tick_rate_hz) {
  *this = Timeline{};
  tick_rate_hz_ = tick_rate_hz;
}

bool Timeline::apply(const PlaybackMessage& playback, double now_s) {
  const double expected = playback_ ? played_to(now_s) : static_cast<double>(playback.moment);
  const double off = std::abs(static_cast<double>(playback.moment) - expected);
  const auto speed = std::max(1.0, std::abs(static_cast<double>(playback.speed)));
  playback_ = playback;
  told_s_ = now_s;
  heeded_ = std::max(heeded_, playback.heeded);
  if (under_way_ && playback.heeded >= under_way_->heeded) under_way_.reset();
  return off > jump_least_s * tick_rate_hz_ * speed;
}

double Timeline::played_to(double now_s) const {
  const double gone_s = playback_->playing ? std::max(now_s - told_s_, 0.0) : 0.0;
  return std::clamp(
      static_cast<double>(playback_->moment) + gone_s * tick_rate_hz_ * static_cast<double>(playback_->speed),
      static_cast<double>(playback_->first), static_cast<double>(playback_->last));
}

double Timeline::moment(double now_s) const {
  if (!waiting_.empty() && is_seek(waiting_.back())) return static_cast<double>(waiting_.back().value);
  if (under_way_ && is_seek(under_way_->wish)) return static_cast<double>(under_way_->wish.value);
  return played_to(now_s);
}

void Timeline::seek(double tick) {
  if (!may_control()) return;
  const double within =
      std::clamp(tick, static_cast<double>(playback_->first), static_cast<double>(playback_->last));
  const ControlReplayRequest wish{.move = ReplayMove::to_tick, .value = std::llround(within)};
  if (!waiting_.empty() && is_seek(waiting_.back()))
    waiting_.back() = wish;
  else
    ask(wish);
}

void Timeline::ask(const ControlReplayRequest& wish) {
  if (!may_control() || waiting_.size() >= limits::replay_wishes_waiting_max) return;
  if (wish.play != ReplayPlay::as_it_is) playback_->playing = wish.play == ReplayPlay::play;
  if (wish.speed != 0.0F) playback_->speed = wish.speed;
  waiting_.push_back(wish);
}

float Timeline::other_speed(bool faster) const {
  const float now = std::abs(playback_->speed);
  float other = now;
  if (faster) {
    const auto next = std::ranges::upper_bound(speeds, now * 1.001F);
    if (next != speeds.end()) other = *next;
  } else {
    const auto next = std::ranges::lower_bound(speeds, now * 0.999F);
    if (next != speeds.begin()) other = *(next - 1);
  }
  return std::copysign(other, playback_->speed);
}

void Timeline::act(Action action) {
  if (!may_control()) return;
  const auto steps = [&](double ticks) { ask({.move = ReplayMove::by_ticks, .value = std::llround(ticks)}); };
  switch (action) {
    case Action::replay_play:
      return ask({.play = playback_->playing ? ReplayPlay::pause : ReplayPlay::play});
    case Action::replay_turn:
      return ask({.play = ReplayPlay::play, .speed = -playback_->speed});
    case Action::replay_slower:
      return ask({.speed = other_speed(false)});
    case Action::replay_faster:
      return ask({.speed = other_speed(true)});
    case Action::replay_second_back:
      return steps(-tick_rate_hz_);
    case Action::replay_second_on:
      return steps(tick_rate_hz_);
    case Action::replay_tick_back:
      return steps(-1.0);
    case Action::replay_tick_on:
      return steps(1.0);
    case Action::replay_previous_event:
      return ask({.move = ReplayMove::previous_event});
    case Action::replay_next_event:
      return ask({.move = ReplayMove::next_event});
    case Action::replay_start:
      return seek(static_cast<double>(playback_->first));
    case Action::replay_end:
      return seek(static_cast<double>(playback_->last));
    default:  // another room's
      return;
  }
}

std::optional<ControlReplayRequest> Timeline::pop_due(double now_s) {
  if (under_way_ && now_s - under_way_->sent_s > limits::replay_move_s) under_way_.reset();
  if (waiting_.empty()) return std::nullopt;
  const bool moves = waiting_.front().move != ReplayMove::stay;
  if (moves && under_way_) return std::nullopt;
  const ControlReplayRequest wish = waiting_.front();
  waiting_.pop_front();
  ++heeded_;
  if (moves) under_way_ = {wish, heeded_, now_s};
  return wish;
}

std::string time_text(double tick, double tick_rate_hz) {
  const auto seconds = static_cast<long>(std::max(tick, 0.0) / tick_rate_hz);
  char text[48];
  if (seconds >= 3600)
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", seconds / 3600, seconds / 60 % 60, seconds % 60);
  else
    std::snprintf(text, sizeof text, "%ld:%02ld", seconds / 60, seconds % 60);
  return text;
}

}  // namespace scree
