// Questions about space on their way to the publisher, which answers them. On the network thread.
#pragma once

#include "server/net/net_server.h"
#include "server/net/session_table.h"

namespace scree {

/// Queues a session's questions. Too many are refused at once, all of a message alike, and counted.
void pass_query(const QueryMessage& query, ClientSession& session, SessionTable& sessions,
                Publisher& publisher, NetStats& counts);

}  // namespace scree
