// Impacts: a contact harder than a piece's strength breaks the piece again around the point of contact; a
// contact hard enough dents soft ground, and throws out the pieces of the dent. Props strike as pieces do,
// and never break. Kinematic props have no mass and meet no terrain; a piece breaks on them as on hard
// ground.
//
// The strongest impacts come first, up to limits::breaks_per_tick_max and dents_per_tick_max; pieces that may
// not break (too small, broken too often already, or no room under WorldConfig::pieces_max) stay whole.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// What a piece is of where it was struck.
const MaterialRow& struck_row(const World::State& state, PieceId piece, glm::vec3 point_m);

/// Call once a tick, right after the bodies' step.
void apply_impacts(World::State& state, TickDelta& delta);

}  // namespace scree
