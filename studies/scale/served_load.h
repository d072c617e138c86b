// How a server's program served a load of bots and viewers, and whether that load holds. Plain values.
#pragma once

#include <cstddef>
#include <vector>

namespace scree {

/// The load of the seconds that count.
struct ServedLoad {
  double server_ms_s = 0.0;      ///< processor time of the server's process, milliseconds a second
  double simulation_ms_s = 0.0;  ///< of it the simulation's thread; its helpers are not in this
  double clients_ms_s = 0.0;     ///< of this process, which is bots and viewers
  double turns_per_s = 0.0;      ///< times at which a bot was to carve, whether it still waited or not
  double carves_per_s = 0.0;     ///< that were carried out
  double refused = 0.0;          ///< share of the answers
  double reply_p99_ms = 0.0;     ///< a request without an answer counts as unanswered_ms
  double ticks_per_s = 0.0;
  double kbit_s_viewer = 0.0;
  double resident_mib = 0.0;
  size_t lost = 0;  ///< connections that ended

  /// 99 of 100 requests are answered within a second, none is refused, no connection ends, at least 59 ticks
  /// a second come, and 95 of 100 turns are carves that were carried out. A bot whose request is not answered
  /// misses its turns, so that a server that is too slow gets fewer requests than the load has.
  bool holds() const;
  /// The server did this load's work, so that its processor time is of this load: none is refused, no
  /// connection ends, at least 59 ticks a second come, and 90 of 100 turns are carves.
  bool carried_out() const;
};

/// A request is to be answered within this.
inline constexpr double reply_max_ms = 1000.0;
/// What a request counts as that has no answer reply_max_ms after the measured seconds.
inline constexpr double unanswered_ms = 2.0 * reply_max_ms;

/// The 99th percentile of the replies' times and of so many requests without one.
double reply_p99_of(std::vector<double> answered_ms, size_t unanswered);

}  // namespace scree
