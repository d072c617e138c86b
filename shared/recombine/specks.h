// Finds specks: terrain of a few voxels that hangs loose, as an odd stamp may leave it.
//
// Solid is a code < 0; voxels connect by faces. Unlike a search for islands (island_search.h) it never asks
// for the ground: whatever connects to more voxels than a speck has is none. It costs what the given bricks
// hold, about a microsecond each. Deterministic.
#pragma once

#include <span>
#include <vector>

#include "shared/falling/island_search.h"

namespace scree {

/// What has more voxels is no speck. A voxel in the air weighs 133 units and more, so three would do; but one
/// that touches the ground by an edge or a corner weighs less, for the ground's own ramp takes its place.
inline constexpr int speck_voxels_max = 32;

/// Components lighter than limits::piece_mass_min that have a voxel in one of these bricks (in order), or
/// against their faces, ordered by start: what an IslandOperation turns into dust.
std::vector<Island> find_specks(Field& field, std::span<const BrickCoord> bricks);

}  // namespace scree
