// A piece's volume as it lies on the terrain's grid. Deterministic; voxels.
#pragma once

#include <vector>

#include "shared/field/piece.h"

namespace scree {

/// The terrain's voxels that lie in the posed volume, or less than half a voxel outside it.
VoxelBox posed_bounds(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// The posed volume's codes on the terrain's grid over `box`, trilinearly; air where its window does not
/// reach.
Window posed_codes(const Volume& volume, const QuantisedPose& pose, float voxel_size_m, const VoxelBox& box);

}  // namespace scree
