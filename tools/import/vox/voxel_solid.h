// A solid of full voxels. Its faces lie half-way between full and empty ones. Internal to import/vox.
#pragma once

#include <map>

#include "tools/import/solid.h"

namespace scree {

/// What the voxels of bricks are of, in voxels of the world: 0 is empty, else a colour. No brick is empty.
using ColouredBricks = std::map<BrickCoord, std::array<uint8_t, brick_voxels>>;

/// `rows`: what each colour is of. The error says that it is beyond the world, or too large.
Result<std::unique_ptr<Solid>> solid_of_voxels(ColouredBricks bricks,
                                               const std::array<VoxelMaterial, 256>& rows,
                                               float voxel_size_m);

}  // namespace scree
