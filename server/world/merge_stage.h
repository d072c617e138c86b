// Recombination: pieces that have come to rest become terrain again.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// The pieces that may merge in this tick, from the ground up. Where nothing merges they freeze instead, and
/// there are none. Call once a tick, after the bodies' step.
std::vector<PieceId> settled(World::State& state, TickDelta& delta);

/// Merges pieces where they lie, in that order; with Methods::group_merges those that stamp_groups puts
/// together in one operation. What the field cannot gain of their mass becomes dust; dust goes out with it.
void merge(World::State& state, const std::vector<PieceId>& ids, TickDelta& delta);

}  // namespace scree
