// Lifting an island out of the terrain: its voxels become a piece, and the field around it becomes that of a
// terrain without it. Where the box cuts through solid terrain, both sides get a flat face halfway between
// their voxels. Pure; lengths in voxels.
#pragma once

#include "shared/field/piece.h"

namespace scree {

/// The voxels that lifting an island with that box may read; those that it may change lie inside.
VoxelBox lift_box(const VoxelBox& island);

/// Takes the solid voxels (code < 0) that connect to `start` within `box` out of the window, and the partial
/// mass of voxels around them that no other rock touches. The distances that these had to the island become
/// those to the remaining solid; all other voxels keep their codes. Returns the island, whose mass is exactly
/// that which the window lost; mass 0 when the start is not solid. `window` must cover lift_box(box), and
/// `box` hold the start.
Volume lift(Window& window, const VoxelBox& box, VoxelCoord start);

}  // namespace scree
