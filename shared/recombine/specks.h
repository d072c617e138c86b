// Finds specks: loose terrain of a few voxels, which an odd stamp may leave.
//
// Solid is a code < 0; voxels connect by faces. Unlike the search for islands (island_search.h) this one
// never looks for the ground: a component of more voxels than speck_voxels_max is no speck. It costs about a
// microsecond a brick. Deterministic.
#pragma once

#include <span>
#include <vector>

#include "shared/falling/island_search.h"

namespace scree {

/// Voxels of the largest speck. A voxel in the air weighs 133 units and more, so three would suffice; but a
/// voxel that touches the ground by an edge or a corner weighs less: removing it leaves the ground's own
/// ramp.
inline constexpr int speck_voxels_max = 32;

/// Components lighter than limits::piece_mass_min with a voxel in one of the bricks, or against their faces,
/// ordered by start. An IslandOperation turns each into dust. The bricks must be in order.
std::vector<Island> find_specks(Field& field, std::span<const BrickCoord> bricks);

}  // namespace scree
