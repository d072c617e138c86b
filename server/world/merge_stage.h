// Recombination: pieces at rest become terrain again.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// Cost of a merge by the model, microseconds: of a living piece, and of a small one. `off` never merges.
float merge_cost_us(const World::State& state, PieceId id);
float least_merge_cost_us(const World::State& state);

/// Finds the pieces that may merge in this tick (State::at_rest), from the ground up. With
/// Recombination::off, freezes them instead and finds none. Call once a tick, after the bodies' step.
void settle(World::State& state, TickDelta& delta);

/// Merges these pieces where they lie, in that order, each after the smaller pieces that lie in its volume;
/// with Methods::group_merges, the pieces of each group by stamp_groups() in one operation. Mass that the
/// field cannot gain becomes dust; earlier dust is merged too, within stamp_budget().
void merge_pieces(World::State& state, const std::vector<PieceId>& ids, TickDelta& delta);

/// Merges the pieces that settle() found.
void merge(World::State& state, TickDelta& delta);

}  // namespace scree
