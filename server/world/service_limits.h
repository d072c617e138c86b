// What a server grants its clients. It travels with the simulation's settings, so that one table, one command
// and one recording hold both; the simulation hands it on (TickDelta::service) and reads nothing of it but
// `persons`.
#pragma once

#include <cstdint>

#include "server/world/persons.h"

namespace scree {

struct ServiceLimits {
  uint32_t sessions_max = 64;         ///< clients at once; above: refused
  double requests_per_second = 30.0;  ///< of one client; above: each gets a reply that refuses it
  /// From a session's eye to the nearest point of its edit, metres; beyond: refused. Administrators edit
  /// anywhere. 0: so does everybody.
  double reach_m = 64.0;
  bool sight = false;  ///< an edit has to be in sight of its session's eye; administrators edit anything
  Persons persons = Persons::fly;

  bool operator==(const ServiceLimits&) const = default;
};

}  // namespace scree
