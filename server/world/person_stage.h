// The stage of a tick in which persons on foot walk, and what becomes of them: their bodies are told where to
// go, before the bodies' step.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// Where the body of a walker is: its middle.
Pose body_pose(const WalkerState& walker);

/// Carries out the inputs that persons may have carried out by now. Who sent none for a while falls and is
/// pushed on. Whom rock came to is pushed out of it.
void walk_persons(World::State& state, TickDelta& delta);

/// Tells of persons whom something struck in this tick (TickDelta::contacts).
void tell_of_hurts(const World::State& state, TickDelta& delta);

/// Enters who is on foot, and where.
void publish_persons(const World::State& state, TickDelta& delta);

}  // namespace scree
