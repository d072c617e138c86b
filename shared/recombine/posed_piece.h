// A piece's volume at its pose, resampled on the terrain's grid. Pure, deterministic; voxels.
#pragma once

#include <vector>

#include "shared/field/piece.h"

namespace scree {

/// A box of the terrain's voxels that holds all voxels in the posed volume or less than half a voxel outside
/// it: at most two voxels too wide on each side, never empty.
VoxelBox posed_bounds(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// How a volume is read between its voxels. codes: trilinearly, which rounds edges and corners within a
/// voxel. planes: by the planes that its codes have at the voxels around, each from the side on which the
/// codes bend least. Where rock is convex the distance is the largest of the planes', where it is hollow the
/// smallest, if these lie beyond the trilinear code; so faces stay flat up to their edges.
enum class Reading { codes, planes };

/// The posed volume's codes on the terrain's grid over `box`; air outside its window.
Window posed_codes(const Volume& volume, const QuantisedPose& pose, float voxel_size_m, const VoxelBox& box,
                   Reading reading = Reading::codes);

/// Bounds of the window's voxels inside the surface or less than half a voxel outside; empty if there are
/// none.
VoxelBox near_box(const Window& window);

}  // namespace scree
