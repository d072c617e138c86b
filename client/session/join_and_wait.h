// Joins a server by a client of a program that has nothing else to do meanwhile.
#pragma once

#include "client/session/client.h"

namespace scree {

/// As client.join(), and waits until the server has welcomed the client, or the attempt has failed: as long
/// as the connector lets it take. Nothing else may be left for client.next() to tell.
tl::expected<void, ConnectionEnd> join_and_wait(Client& client, const HelloMessage& hello);

}  // namespace scree
