#include "client/session/playback.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/session/limits.h"

namespace scree {

void Playback::start(const WelcomeMessage& welcome) {
  *this = Playback{};
  rate_hz_ = std::max(1.0, static_cast<double>(welcome.tick_rate_hz));
  transform_ticks_ = static_cast<double>(welcome.ticks_per_transform);
}

void Playback::push(Received received) {
  if (const auto* frame = std::get_if<FrameMessage>(&received.message))
    note_arrival(frame->tick, received.arrived_s());
  waiting_.push_back(std::move(received));
}

void Playback::note_arrival(Tick tick, double now_s) {
  const double start_s = now_s - static_cast<double>(tick) / rate_hz_;
  // A jump: a replay that was moved, or a machine that slept. The clock restarts.
  if (start_s_ && std::abs(start_s - *start_s_) > limits::playback_jump_s) {
    start_s_.reset();
    clock_ = 0.0;
  }
  if (!start_s_ || start_s < *start_s_) {
    start_s_ = start_s;
  } else {
    *start_s_ += (start_s - *start_s_) * limits::playback_drift;
  }
  newest_ = tick;
}

double Playback::clock(double now_s) {
  if (!start_s_) return clock_;
  const double behind_s = limits::playback_delay_s - transform_ticks_ / rate_hz_;
  const double wanted = (now_s - *start_s_ - std::max(behind_s, 0.0)) * rate_hz_;
  const double last = static_cast<double>(newest_) + limits::playback_quiet_s * rate_hz_;
  clock_ = std::clamp(wanted, clock_, std::max(clock_, last));
  return clock_;
}

std::optional<Received> Playback::pop_next(double now_s) {
  overfull_ = !waiting_.empty() && (overfull_ || waiting_.size() > limits::playback_messages_max);
  if (waiting_.empty()) return std::nullopt;
  const auto* frame = std::get_if<FrameMessage>(&waiting_.front().message);
  if (frame != nullptr && static_cast<double>(frame->tick) > clock(now_s) && !overfull_) return std::nullopt;
  return take_first();
}

std::optional<Received> Playback::take_first() {
  if (waiting_.empty()) return std::nullopt;
  Received first = std::move(waiting_.front());
  waiting_.pop_front();
  return first;
}

double Playback::draw_tick(double now_s) {
  return clock(now_s) - transform_ticks_;
}

}  // namespace scree
