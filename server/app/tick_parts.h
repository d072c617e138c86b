// Where the time of a server's tick goes, beside the stages of the world's own (server/world/stages.h), and
// why ticks are late. Values.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <string_view>

#include "shared/base/kind_table.h"

namespace scree {

/// In the order in which a tick goes through them.
enum class TickPart : uint8_t {
  terrain,     ///< terrain that comes in from the world's file, and what waits for it
  rules,       ///< the host's hooks, before and after
  simulation,  ///< the world's tick, or that of a recording
  keep,        ///< recording, saving, terrain that goes out
  hand_over,   ///< waiting for the network thread
};

struct TickPartRow {
  std::string_view name;
};

constexpr TickPartRow row_of(TickPart part) {
  switch (part) {
    case TickPart::terrain:
      return {"terrain"};
    case TickPart::rules:
      return {"rules"};
    case TickPart::simulation:
      return {"simulation"};
    case TickPart::keep:
      return {"keep"};
    case TickPart::hand_over:
      return {"hand_over"};
  }
  return {};
}

struct TickParts {
  std::array<double, kind_count<TickPart>> ms{};
  double cpu_ms = 0.0;  ///< processor time of the simulation's thread, in all

  double& operator[](TickPart part) { return ms[static_cast<size_t>(part)]; }
  double operator[](TickPart part) const { return ms[static_cast<size_t>(part)]; }
  double total_ms() const { return std::accumulate(ms.begin(), ms.end(), 0.0); }
};

/// Late ticks by their cause, which is the largest part of the tick before. Where that one was short enough,
/// an earlier one is the cause. Where its thread had the processor for less than half of the time, it waited
/// for one, for its helpers, or for a disk.
struct LateTicks {
  std::array<uint64_t, kind_count<TickPart>> by_part{};
  uint64_t earlier = 0;
  uint64_t waiting = 0;

  void add(const TickParts& before, double period_ms) {
    const double total_ms = before.total_ms();
    if (total_ms <= period_ms)
      ++earlier;
    else if (before.cpu_ms < total_ms / 2)
      ++waiting;
    else
      ++by_part[static_cast<size_t>(std::ranges::max_element(before.ms) - before.ms.begin())];
  }
};

}  // namespace scree
