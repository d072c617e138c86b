// Recombination: pieces at rest become terrain again.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// The pieces that may merge in this tick, from the ground up. With Recombination::off, freezes them instead
/// and returns none. Call once a tick, after the bodies' step.
std::vector<PieceId> settled(World::State& state, TickDelta& delta);

/// Merges pieces where they lie, in that order; with Methods::group_merges, the pieces of each group by
/// stamp_groups() in one operation. Mass that the field cannot gain becomes dust; earlier dust is merged too,
/// within stamp_budget().
void merge(World::State& state, const std::vector<PieceId>& ids, TickDelta& delta);

}  // namespace scree
