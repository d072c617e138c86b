// A piece's volume at its pose, resampled on the terrain's grid. Pure, deterministic; voxels.
#pragma once

#include <vector>

#include "shared/field/piece.h"

namespace scree {

/// A box of the terrain's voxels that holds all voxels in the posed volume or less than half a voxel outside
/// it: at most two voxels too wide on each side, never empty.
VoxelBox posed_bounds(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// The posed volume's codes on the terrain's grid over `box`, by trilinear interpolation; air outside its
/// window.
Window posed_codes(const Volume& volume, const QuantisedPose& pose, float voxel_size_m, const VoxelBox& box);

/// Bounds of the window's voxels inside the surface or less than half a voxel outside; empty if there are
/// none.
VoxelBox near_box(const Window& window);

}  // namespace scree
