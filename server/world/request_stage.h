// The tick's first stage: requests are validated, carried out and answered.
#pragma once

#include <span>

#include "server/world/world_state.h"

namespace scree {

/// Carries out what waits and then these, as far as the tick's budget goes, and at least one; the others
/// wait, in order. More than limits::requests_waiting_max are refused.
void carry_out(World::State& state, std::span<const Command> commands, TickDelta& delta);

/// Carries out one request, or refuses it by name; either way the delta has a reply to it.
void execute(World::State& state, const Command& command, TickDelta& delta);

}  // namespace scree
