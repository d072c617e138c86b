// The tick's first stage: requests are validated, carried out and answered.
#pragma once

#include <span>

#include "server/world/world_state.h"

namespace scree {

/// The commands wait behind those that wait already; beyond limits::requests_waiting_max they are refused.
void take_in(World::State& state, std::span<const Command> commands, TickDelta& delta);

/// Carries out the waiting commands in order: at least one, and more as far as the tick's budget goes. Each
/// gets one reply.
void carry_out(World::State& state, TickDelta& delta);

/// Enters the values of all settings in the delta.
void publish_settings(const World::State& state, TickDelta& delta);

/// Carries out one request, or refuses it with a reason; the delta gets the reply.
void execute(World::State& state, const Command& command, TickDelta& delta);

}  // namespace scree
