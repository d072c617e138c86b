// A storm of blows seen by many viewers on loopback, all on this machine's cores: how old frames are when
// they have been read, and what showing it takes.
#pragma once

#include <cstdint>
#include <string>

#include "bench/wire/drains.h"

namespace scree {

struct Spectators {
  size_t viewers = 100;
  float spread_m = 0.0F;  ///< their eyes lie within this of the origin
  size_t mirrors = 10;    ///< more viewers, who apply everything and check every hash
  double seconds = 12.0;
};

struct AudienceOutcome {
  AgeCount ages;  ///< of frames, from the moment in which the simulation handed their tick over
  uint64_t ticks = 0;
  uint64_t late_ticks = 0;
  double kbit_s_a_viewer = 0.0;
  double kib_a_viewer = 0.0;  ///< of this process, the viewers' own part included
  double tick_cpu_ms = 0.0;   ///< processor time of the simulation's thread a tick, on average
  double net_cpu_ms = 0.0;    ///< of all threads but that and the viewers', a tick, on average
  uint64_t resets = 0;
  size_t lost = 0;  ///< viewers whose connection ended
  uint64_t checks = 0;
  uint64_t mismatches = 0;
  std::string failure;  ///< of a mirror
};

/// An error when the server or a viewer cannot begin.
Result<AudienceOutcome> show_storm(const Spectators& audience);

}  // namespace scree
