// When a client that has no server tries again: soon at first, as long as a server takes to start anew, then
// ever less often; never after a refusal that stays (come_again.h). Seconds of any clock, as arguments.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace scree {

class Attempts {
 public:
  /// Whether the next attempt may begin. The first one may at once.
  bool due(double now_s) const { return !gave_up_ && now_s >= next_s_; }
  /// An attempt has led to a connection, or it or a connection has ended; `refusal`: its name, or empty.
  void joined(double now_s) { joined_s_ = now_s; }
  void lost(double now_s, std::string_view refusal);
  /// The next attempt is now, if there is one.
  void try_now() { next_s_ = 0.0; }

  /// Whether there is no other attempt: the refusal stays.
  bool gave_up() const { return gave_up_; }
  /// Seconds until the next attempt; 0: it is due.
  double wait_s(double now_s) const { return next_s_ > now_s ? next_s_ - now_s : 0.0; }

 private:
  bool gave_up_ = false;
  double next_s_ = 0.0;
  uint32_t failures_ = 0;  ///< attempts that led to nothing since a connection that was worth something
  std::optional<double> joined_s_;
};

}  // namespace scree
