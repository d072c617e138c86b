// Blasts (BlastRequest): how far one breaks the terrain, and how it throws what moves about. Deterministic;
// metres, joules.
#pragma once

#include "server/world/world_state.h"
#include "shared/operation/request.h"

namespace scree {

/// Radius of the ball about the centre in which the blast breaks all rock: the energy that this takes, from
/// the middle outward, is the blast's. It is no farther than a half ball of that ground would reach, because
/// what goes off in the air breaks little. Nothing: there is no rock so near.
std::optional<float> blast_radius_m(const World::State& state, const BlastRequest& blast);

/// The carve that a blast is by these rules (rules.h), into at most so many pieces.
CarveRequest carve_of(const BlastRequest& blast, float radius_m, uint32_t seeds, uint32_t by_rules);

/// Throws pieces and props about: each gets the impulse of the shock wave on its face. A wave's impulse on a
/// square metre is 200 W^⅔ / R Pa s, of W kg of TNT (4.184 MJ) at R metres (M. A. Sadovsky, 1952). Rock
/// between shields: 2 m of it take nine tenths.
void throw_bodies(World::State& state, const BlastRequest& blast);

}  // namespace scree
