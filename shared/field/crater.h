// The wall of a crater: rock does not break along a ball, but along its joints. Pure, deterministic; voxels.
//
// The world is divided into blocks: the Voronoi cells of points, one in each cube of a lattice, whose places
// are hashes of the cube. A crater takes out the blocks whose points lie in its ball and not near its border,
// and of them what lies in the ball. So it lies within the ball, its wall has the flat faces, the edges and
// the corners of the blocks that stay, and craters of one size that meet follow the same joints.
#pragma once

#include "shared/field/shape.h"
#include "shared/field/window.h"

namespace scree {

/// Side of the lattice's cubes for a ball of that radius: blocks are about so large. Smaller ones would be no
/// more than roughness of the grid.
int crater_block_side(float radius_voxels);

/// The crater's distances over `box`, as codes: those over its band_box(), and air beyond. They are made from
/// where the wall crosses the grid (distances_from_levels), so they grow by at most 1 a voxel.
Window crater_codes(const Shape& crater_voxels, const VoxelBox& box);

}  // namespace scree
