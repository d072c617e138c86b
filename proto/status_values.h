// Parts of a status (proto/status.proto).
#pragma once

#include <cstdint>
#include <string>

namespace scree {

/// How long a stage of the tick took.
struct StageTime {
  std::string name;
  float ms = 0.0F;

  bool operator==(const StageTime&) const = default;
};

/// The work of the last second's ticks by the server's model, and the counts of work that did not fit.
struct WorkStatus {
  uint32_t budget_us = 0;         ///< of a tick; 0: not known, as in a replay
  uint32_t worst_us = 0;          ///< largest work of a tick
  uint32_t requests_waiting = 0;  ///< most at a tick's end
  uint32_t merges_put_off = 0;    ///< most at a tick's end
  uint32_t breaks_left_out = 0;   ///< in all
  uint32_t dents_left_out = 0;    ///< in all
  uint32_t ticks_cut_short = 0;   ///< in which any of these happened
  uint32_t ticks_merging_sooner = 0;
  uint32_t supports_put_off = 0;   ///< most bricks at a tick's end that await a search for support
  uint32_t islands_put_off = 0;    ///< most islands at a tick's end that wait to fall
  uint32_t islands_too_large = 0;  ///< components taken for ground, in all

  bool operator==(const WorkStatus&) const = default;
};

/// How often a server gave one reason for refusing a request or a session.
struct RefusalCount {
  std::string reason;
  uint64_t count = 0;

  bool operator==(const RefusalCount&) const = default;
};

}  // namespace scree
