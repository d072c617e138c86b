// What a welcome says to every client alike.
#pragma once

#include <cstdint>

#include "proto/messages.h"
#include "server/net/net_server.h"

namespace scree {

/// A welcome without the session's own part: number, tick, interest, role, ticket. `world`: as of
/// WelcomeMessage.
WelcomeMessage welcome_of(const NetConfig& config, uint64_t world);

}  // namespace scree
