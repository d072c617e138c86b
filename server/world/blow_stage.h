// Blows break terrain off (shared/falling/blow_search.h).
//
// A plastic contact's force is at most the softer material's hardness times the area of the dent that its
// energy makes (Johnson, Contact Mechanics, 1985, 11.5). For a cap of the shape that dents have, that is
// F = 2.44 H^⅓ E^⅔: it does not depend on the length of a tick, and grows with the energy. Where terrain
// breaks at a part s of F, breaking took s^(3/2) of the energy. The body gets back the rest of its speed, and
// the pieces of what was crushed get at most what it gave until then: there never is more energy than before.
// What hangs on the necks is an island of the same tick, which the body strikes in the next one.
//
// The strongest blows come first, by the parties' turns, up to limits::blows_per_tick_max searches and as far
// as the tick's budget goes; what is left out is counted. Part of what terrain suffers from blows, as dents
// are: Methods::dents switches it, and Methods::islands must be on.
#pragma once

#include <map>

#include "server/world/world_state.h"

namespace scree {

/// Call once a tick, after the bodies' step and after their impacts were read. Returns the part of its
/// impulse on terrain that each piece bore until the terrain broke: 0 to 1, for those that broke any. Pieces
/// of `delta.spawned` break nothing: they strike the hole that they were just blown out of.
std::map<PieceId, float> break_terrain(World::State& state, TickDelta& delta);

/// The greatest force of a plastic contact, newtons: of that energy, on material of that hardness.
float force_of_blow(float energy_j, float hardness_pa);

}  // namespace scree
