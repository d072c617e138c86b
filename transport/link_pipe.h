// One direction of a simulated link, without clock and sockets: bytes go in as the bottleneck has room, and
// come out in order when their time has come. Time is an argument (seconds, never going back); the same calls
// and seed give the same times. Not thread-safe.
//
// A packet leaves the bottleneck when all before it have left and its own bytes' time at the link's rate is
// over; then it is under way for the delay and a part of the jitter.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "shared/base/random.h"
#include "transport/link_config.h"

namespace scree {

class LinkPipe {
 public:
  LinkPipe(const LinkWay& way, uint64_t random_seed) : way_(way), random_(random_seed) {}

  /// Bytes that go in now. 0 for ever after the cut, and when nothing passes any more.
  size_t room(double now_s) const;
  /// At most room() bytes.
  void push(std::span<const uint8_t> bytes, double now_s);
  /// Takes bytes that have come out; how many.
  size_t pop(std::span<uint8_t> into, double now_s);

  /// When more comes out, or there is more room: later than now; nothing: never, or not before something is
  /// pushed or popped.
  std::optional<double> next_s(double now_s) const;
  bool empty() const { return packets_.empty(); }
  /// Everything before the cut has come out.
  bool severed() const { return way_.cut_bytes && popped_bytes_ >= *way_.cut_bytes; }
  uint64_t popped_bytes() const { return popped_bytes_; }

 private:
  struct Packet {
    std::vector<uint8_t> bytes;
    double arrives_s = 0.0;
  };
  uint64_t may_still_pass() const;
  double waiting_bytes(double now_s) const;

  LinkWay way_;
  Random random_;
  std::deque<Packet> packets_;
  size_t front_popped_bytes_ = 0;  ///< of the first packet
  size_t flight_bytes_ = 0;        ///< in packets_
  uint64_t pushed_bytes_ = 0;
  uint64_t popped_bytes_ = 0;
  double free_s_ = 0.0;  ///< when the bottleneck has sent all that it was given
};

}  // namespace scree
