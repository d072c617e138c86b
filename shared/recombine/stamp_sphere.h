// Recombination by a sphere, as the paper's own program did it (section 4.1): a ball of terrain where the
// fragment's centre of mass came to rest, whatever its shape.
//
// The paper does not say how large. Here the ball has the piece's volume, and grows where the ground already
// fills a part of it, until the terrain gains the piece's mass; what the largest ball cannot hold is dust.
#pragma once

#include "shared/recombine/stamp.h"

namespace scree {

/// The voxels that any shift's ball may read and change.
VoxelBox stamp_sphere_box(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// Radius of the ball, voxels: that of the piece's volume at shift 0, half as much again at stamp_shift_max,
/// none at −stamp_shift_max, where nothing changes. `window` must cover stamp_sphere_box.
void stamp_sphere(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m,
                  int shift);

/// As plan_stamp, but the gain never exceeds a budget that is not negative.
StampPlan plan_sphere(const Window& window, const Volume& volume, const QuantisedPose& pose,
                      float voxel_size_m, MassUnits budget);

}  // namespace scree
