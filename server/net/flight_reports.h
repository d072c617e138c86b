// What a host keeps of its last ticks, for administrators who ask; called on the network thread.
#pragma once

#include <functional>
#include <vector>

#include "proto/admin_message.h"

namespace scree {

/// Each may be empty: then there is nothing to tell.
struct FlightReports {
  std::function<std::vector<SlowTickRow>(const ListFlightRequest&)> ticks;
  /// Rows of work alone; the network side adds the sessions.
  std::function<std::vector<PartyRow>()> parties;
};

}  // namespace scree
