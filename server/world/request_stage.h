// The tick's first stage: requests are validated, carried out and answered.
#pragma once

#include <span>

#include "server/world/world_state.h"

namespace scree {

/// The commands wait behind those of the same client; what is invalid, and what RequestQueue::push() refuses,
/// gets its reply at once. So does what waits for a session that leaves: it is dropped.
void enqueue_commands(World::State& state, std::span<const Command> commands, TickDelta& delta);

/// Carries out waiting commands by the clients' turns: at least one unless earlier ones are still to be paid
/// back, and more as far as the tick's budget goes. A carve whose client has to share the room for pieces
/// gets fewer pieces than it asked for, waits a little, or is refused. Each command gets one reply.
void carry_out(World::State& state, TickDelta& delta);

/// Whether a command may wait for its turn: it is valid, or what is wrong may be so since it began to wait.
/// It is checked again when its turn comes.
bool may_wait_for_turn(const World::State& state, const Command& command);

/// Enters the values of all settings in the delta.
void publish_settings(const World::State& state, TickDelta& delta);

}  // namespace scree
