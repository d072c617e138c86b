// The protocol that a client shares with the server, and what a welcome says to every client alike.
#pragma once

#include <cstdint>

#include "proto/messages.h"
#include "server/command/refusal.h"
#include "server/net/net_server.h"

namespace scree {

/// Refuses a client that does not speak the server's protocol. The reason names the numbers of both.
tl::expected<void, Refused> find_protocol(const HelloMessage& hello);

/// A welcome without the session's own part: number, tick, interest, role, ticket. `world`: as of
/// WelcomeMessage.
WelcomeMessage welcome_of(const NetConfig& config, uint64_t world);

}  // namespace scree
