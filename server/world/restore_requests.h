// What the server itself takes back: bricks become what they were, pieces go.
#pragma once

#include "server/world/prop_requests.h"

namespace scree {

CheckedRequest check(const World::State& state, const RestoreRequest& request, uint64_t session);

/// Carries out a request that has passed check(): bricks that have the hash that they are to have, and pieces
/// that there are. Returns the number of pieces that went; `delta` has the operation.
uint32_t perform(World::State& state, const RestoreRequest& request, uint64_t party, TickDelta& delta);

}  // namespace scree
