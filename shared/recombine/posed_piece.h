// A piece's volume as it lies on the terrain's grid. Deterministic; voxels.
#pragma once

#include <vector>

#include "shared/field/piece.h"

namespace scree {

/// A box of the terrain's voxels with all that lie in the posed volume or less than half a voxel outside it,
/// from the volume's rows: at most two voxels too wide on each side.
VoxelBox posed_bounds(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// The posed volume's codes on the terrain's grid over `box`, trilinearly; air where its window does not
/// reach.
Window posed_codes(const Volume& volume, const QuantisedPose& pose, float voxel_size_m, const VoxelBox& box);

/// Bounds of the window's voxels inside, or less than half a voxel outside; empty where there are none.
VoxelBox near_box(const Window& window);

}  // namespace scree
