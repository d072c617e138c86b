// The tick's first stage: requests are validated, carried out and answered.
#pragma once

#include <span>

#include "server/world/world_state.h"

namespace scree {

/// Carries out the waiting commands and then these: at least one, and more as far as the tick's budget goes.
/// The others wait, in order; beyond limits::requests_waiting_max they are refused. Each gets one reply.
void carry_out(World::State& state, std::span<const Command> commands, TickDelta& delta);

/// Carries out one request, or refuses it with a reason; the delta gets the reply.
void execute(World::State& state, const Command& command, TickDelta& delta);

}  // namespace scree
