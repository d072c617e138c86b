// The tick's first stage: requests are validated, carried out and answered.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// Carries out one request, or refuses it by name; either way the delta has a reply to it.
void execute(World::State& state, const Command& command, TickDelta& delta);

}  // namespace scree
