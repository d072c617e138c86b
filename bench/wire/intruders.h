// Clients that misbehave beside honest ones, each kind by a way of its own, and an honest one whose terrain
// is to fall soon all the same. On loopback, a thread for each kind.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

namespace scree {

using BenchClock = std::chrono::steady_clock;

struct IntruderKind {
  const char* name;
  void (*intrude)(uint16_t port, BenchClock::time_point end);
};

const std::vector<IntruderKind>& intruder_kinds();

/// Builds a tower, cuts it at its foot and waits for its fall, again and again until `end`: seconds from each
/// cut to the fall; the wait so far for one that does not fall.
std::vector<double> falls_of_towers(uint16_t port, BenchClock::time_point end);

}  // namespace scree
