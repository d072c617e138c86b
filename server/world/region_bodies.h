// Bodies and regions: pieces that may not come into one, and events of those that enter and leave, by their
// middles. Where no region asks for it, it costs nothing.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// Where bodies are before a step moves them; nothing where no region wants to know.
std::vector<BodyState> places_before_step(const World::State& state);

/// Puts pieces back that came into a region which they may not enter, and tells who crossed the surface of
/// one that tells, on his straight way from where he was before the step. Call right after the step.
void meet_regions(World::State& state, std::span<const BodyState> before, TickDelta& delta);

/// Tells of bodies that came to be in a region, or are no more, or were put elsewhere. Call when the tick has
/// changed all that it changes.
void tell_of_regions(World::State& state, TickDelta& delta);

/// Notes the bodies in a region that tells, and tells of none.
void note_inside(World::State& state, RegionId id);

}  // namespace scree
