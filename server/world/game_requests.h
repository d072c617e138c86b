// What a host's rules do in a world besides what persons can ask for. Only the server itself (session 0) may.
#pragma once

#include "server/world/prop_requests.h"
#include "server/world/world_state.h"

namespace scree {

/// Refuses what no wait could mend.
CheckedRequest check(const World::State& state, const RulesRequest& request, uint64_t session);
/// Carries out a request that has passed check() now, or refuses it and changes nothing. Returns 0.
Performed perform(World::State& state, const RulesRequest& request, TickDelta& delta);

/// Takes out the signs that ended. To be called first in a tick.
void end_signs(World::State& state, TickDelta& delta);
/// The session cannot go on: what the rules made of its person is forgotten.
void leave_game(World::State& state, uint64_t session, TickDelta& delta);

/// Who asks, in the team that the rules gave him.
Asker asker_in_game(const World::State& state, const Command& command);

}  // namespace scree
