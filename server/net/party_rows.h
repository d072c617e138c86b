// Work by party, with the sessions that each party has. On the network thread.
#pragma once

#include <vector>

#include "proto/flight_rows.h"
#include "server/net/session_table.h"

namespace scree {

/// Adds those that have joined: parties that did nothing yet get a row, too. The one that works most comes
/// first.
std::vector<PartyRow> with_sessions(std::vector<PartyRow> work, const SessionTable& sessions);

}  // namespace scree
