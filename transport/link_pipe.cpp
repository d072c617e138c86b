#include "transport/link_pipe.h"

#include <algorithm>
#include <limits>

#include "shared/base/check.h"
#include "transport/limits.h"

namespace scree {

/// Bytes until the cut, or until nothing passes any more.
uint64_t LinkPipe::may_still_pass() const {
  constexpr uint64_t endless = std::numeric_limits<uint64_t>::max();
  const uint64_t last = std::min(way_.cut_bytes.value_or(endless), way_.half_open_bytes.value_or(endless));
  return last - std::min(last, pushed_bytes_);
}

double LinkPipe::waiting_bytes(double now_s) const {
  return std::max(0.0, free_s_ - now_s) * way_.rate_bytes_per_s;
}

size_t LinkPipe::room(double now_s) const {
  const auto waiting = static_cast<size_t>(waiting_bytes(now_s) + 0.5);
  const size_t buffer = buffer_of(way_) - std::min(buffer_of(way_), waiting);
  const size_t flight =
      limits::link_flight_max_bytes - std::min(limits::link_flight_max_bytes, flight_bytes_);
  return static_cast<size_t>(std::min<uint64_t>(std::min(buffer, flight), may_still_pass()));
}

void LinkPipe::push(std::span<const uint8_t> bytes, double now_s) {
  CHECK(bytes.size() <= room(now_s));
  for (size_t at = 0; at < bytes.size(); at += limits::link_packet_bytes) {
    const auto part = bytes.subspan(at, std::min(limits::link_packet_bytes, bytes.size() - at));
    free_s_ = std::max(free_s_, now_s);
    if (way_.rate_bytes_per_s > 0.0) free_s_ += static_cast<double>(part.size()) / way_.rate_bytes_per_s;
    const double arrives_s = free_s_ + way_.delay_s + way_.jitter_s * static_cast<double>(random_.unit());
    const double before_s = packets_.empty() ? arrives_s : packets_.back().arrives_s;
    packets_.push_back({{part.begin(), part.end()}, std::max(arrives_s, before_s)});
  }
  flight_bytes_ += bytes.size();
  pushed_bytes_ += bytes.size();
}

size_t LinkPipe::pop(std::span<uint8_t> into, double now_s) {
  size_t taken = 0;
  while (taken < into.size() && !packets_.empty() && packets_.front().arrives_s <= now_s) {
    const auto rest = std::span<const uint8_t>(packets_.front().bytes).subspan(front_popped_bytes_);
    const size_t count = std::min(rest.size(), into.size() - taken);
    std::copy_n(rest.begin(), count, into.begin() + static_cast<ptrdiff_t>(taken));
    taken += count;
    front_popped_bytes_ += count;
    if (count < rest.size()) break;
    packets_.pop_front();
    front_popped_bytes_ = 0;
  }
  flight_bytes_ -= taken;
  popped_bytes_ += taken;
  return taken;
}

std::optional<double> LinkPipe::next_s(double now_s) const {
  std::optional<double> next;
  if (!packets_.empty() && packets_.front().arrives_s > now_s) next = packets_.front().arrives_s;
  // Half of the buffer empty: bytes then go in by the packet, not one by one.
  const auto half = static_cast<double>(buffer_of(way_)) / 2.0;
  if (way_.rate_bytes_per_s > 0.0 && waiting_bytes(now_s) > half + 1.0 && may_still_pass() > 0) {
    const double room_s = free_s_ - half / way_.rate_bytes_per_s;
    next = std::min(next.value_or(room_s), room_s);
  }
  return next;
}

}  // namespace scree
