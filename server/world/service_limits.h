// What a server grants its clients. It travels with the simulation's settings, so that one table, one command
// and one recording hold both; the simulation hands it on (TickDelta::service) and never reads it: no hash
// depends on it.
#pragma once

#include <cstdint>

namespace scree {

struct ServiceLimits {
  uint32_t sessions_max = 64;         ///< clients at once; above: refused
  double requests_per_second = 30.0;  ///< of one client; above: each gets a reply that refuses it
  /// From a session's eye to the nearest point of its edit, metres; beyond: refused. Administrators edit
  /// anywhere.
  double reach_m = 64.0;

  bool operator==(const ServiceLimits&) const = default;
};

}  // namespace scree
