// Regions as part of a world: the requests that set and remove them, what they refuse to others, how they
// end, and what becomes of the terrain that they held. Refusals that no wait could mend are those of check().
#pragma once

#include "server/command/command.h"
#include "server/world/prop_requests.h"
#include "server/world/world_state.h"

namespace scree {

CheckedRequest check(const World::State& state, const SetRegionRequest& request);
CheckedRequest check(const World::State& state, const RemoveRegionRequest& request);

/// Refuses a valid request that edits terrain, or a piece, in a region in which who asks may not edit. The
/// server itself may everywhere.
CheckedRequest check_regions(const World::State& state, const Command& command);

/// Carries out a request that has passed check() now. Returns 0.
uint32_t perform(World::State& state, const SetRegionRequest& request, uint64_t party, TickDelta& delta);
uint32_t perform(World::State& state, const RemoveRegionRequest& request, uint64_t party, TickDelta& delta);

/// Takes out the regions whose last tick was the one before. To be called first in a tick.
void end_regions(World::State& state, TickDelta& delta);

/// Lets some of the terrain be searched that hung on regions which are over. To be called before the stages
/// that search.
void release_terrain(World::State& state);

/// Enters the regions of a kept world. Refuses ids that are none yet, or somebody else's. Bodies must be
/// entered before.
Result<void> restore_regions(World::State& state, const WorldMoment& moment);
void enter_regions(const World::State& state, WorldMoment& moment);

}  // namespace scree
