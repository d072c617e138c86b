// What a server is measured by while viewers look at it: rest, carves, and somebody who joins after them. The
// same for Scree's and for Luanti's.
#pragma once

#include <chrono>
#include <cstdint>
#include <glm/vec3.hpp>
#include <thread>
#include <vector>

#include "shared/base/quantile.h"
#include "shared/base/result.h"
#include "shared/base/timing.h"

namespace scree {

inline constexpr double carve_every_s = 2.0;  ///< Luanti has sent all of one before the next
inline constexpr double joined_within_s = 30.0;
/// A viewer that gets less than so many bytes in each of so many half seconds has all that it needs.
inline constexpr uint64_t quiet_bytes = 3000;
inline constexpr double sample_interval_s = 0.5;
inline constexpr int quiet_samples = 5;
inline constexpr int joins = 3;  ///< one after the other

struct Session {
  double idle_cpu = 0.0;         ///< of a core, at rest, all viewers there
  double carve_cpu_ms = 0.0;     ///< of all that follows a carve, less that at rest
  double carve_blocks_ms = 0.0;  ///< that a carve holds a step up; median
  double carve_bytes = 0.0;      ///< to each viewer, of all that follows
  double late_step_ms = 0.0;     ///< the same, of which one in a hundred is longer; 0: not told
  double step_ms = 0.0;          ///< from step to step; mean while carving
  double join_bytes = 0.0;       ///< of one who comes after the carves
  double join_s = 0.0;
  double viewer_mib = 0.0;  ///< of the server, for one viewer more
};

inline void wait_s(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Waits until that holds; false: it did not within so many seconds.
template <typename Condition>
bool holds_within(double seconds, Condition condition) {
  const double until_s = steady_now_s() + seconds;
  while (!condition()) {
    if (steady_now_s() > until_s) return false;
    wait_s(0.02);
  }
  return true;
}

/// Waits until `bytes`, of one viewer, grow by less than `least` from look to look; seconds until the last
/// look at which they did not. Gives up after `within_s`.
template <typename Bytes>
double seconds_until_quiet(Bytes bytes, uint64_t least = quiet_bytes, double within_s = joined_within_s) {
  const double begin_s = steady_now_s();
  double last_s = begin_s;
  uint64_t before = bytes();
  for (int samples = 0; samples < quiet_samples && steady_now_s() < begin_s + within_s; ++samples) {
    wait_s(sample_interval_s);
    const uint64_t now = bytes();
    if (now - before >= least) {
      samples = -1;
      last_s = steady_now_s();
    }
    before = now;
  }
  return last_s - begin_s;
}

/// What a server took within some time.
struct PhaseUsage {
  double seconds = 0.0, cpu_s = 0.0, bytes = 0.0;
};

/// Both kinds of server, with what the phases have in common: rest, carves and the time until all is over,
/// and rest again. What is taken at rest is no carve's.
template <typename Cpu, typename Bytes, typename Carve, typename Settle>
void rest_and_carve(Session& session, size_t viewers, const std::vector<glm::ivec3>& at, double rest_s,
                    Cpu cpu_s, Bytes bytes, Carve carve, Settle settle) {
  const auto during = [&](auto phase) {
    const double begin_s = steady_now_s(), cpu_before_s = cpu_s();
    const uint64_t bytes_before = bytes();
    phase();
    return PhaseUsage{steady_now_s() - begin_s, cpu_s() - cpu_before_s,
                      static_cast<double>(bytes() - bytes_before)};
  };
  const auto rest = [&] { wait_s(rest_s); };
  const PhaseUsage before = during(rest);
  const PhaseUsage carving = during([&] {
    for (const glm::ivec3& place : at) {
      carve(place);
      wait_s(carve_every_s);
    }
    settle();
  });
  const PhaseUsage after = during(rest);
  const double rests_s = before.seconds + after.seconds;
  session.idle_cpu = (before.cpu_s + after.cpu_s) / rests_s;
  const double idle_bytes_s = (before.bytes + after.bytes) / rests_s;
  const auto carves = static_cast<double>(at.size());
  session.carve_cpu_ms = 1e3 * (carving.cpu_s - session.idle_cpu * carving.seconds) / carves;
  session.carve_bytes =
      (carving.bytes - idle_bytes_s * carving.seconds) / carves / static_cast<double>(viewers);
}

/// Some who join one after the other: medians. `add` returns once the server has let one in, the time from
/// which on that one's join counts; `bytes` are those of the last.
template <typename Add, typename Bytes>
Result<void> measure_joins(Session& session, Add add, Bytes bytes) {
  std::vector<double> seconds, received;
  for (int i = 0; i < joins; ++i) {
    const Result<double> begin_s = add();
    if (!begin_s) return fail(begin_s.error().message);
    const double let_in_s = steady_now_s() - *begin_s;
    seconds.push_back(let_in_s + seconds_until_quiet(bytes));
    received.push_back(static_cast<double>(bytes()));
  }
  session.join_s = quantile(seconds, 0.5);
  session.join_bytes = quantile(received, 0.5);
  return {};
}

}  // namespace scree
