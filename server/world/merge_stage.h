// Recombination: pieces that have come to rest become terrain again.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// The pieces that may merge in this tick, from the ground up. Where nothing merges they freeze instead, and
/// there are none. Call once a tick, after the bodies' step.
std::vector<PieceId> settled(World::State& state, TickDelta& delta);

/// Merges a piece where it lies. What the field cannot gain of its mass becomes dust; dust goes out with it.
void merge(World::State& state, PieceId id, TickDelta& delta);

}  // namespace scree
