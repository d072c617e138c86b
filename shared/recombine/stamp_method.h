// One interface to the methods by which a piece becomes terrain again.
#pragma once

#include "shared/recombine/stamp.h"

namespace scree {

/// The voxels that a stamp by this method may read and change, whatever its shift.
VoxelBox stamp_box(StampMethod method, const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// Merges the piece into `window`, which must cover the method's stamp_box(); the shift lies within
/// ±stamp_shift_max.
void stamp(StampMethod method, Window& window, const Volume& volume, const QuantisedPose& pose,
           float voxel_size_m, int shift);

/// Finds the shift whose gain comes nearest the budget, and this gain, exactly; each method's own plan says
/// when the gain may exceed the budget.
StampPlan plan_stamp(StampMethod method, const Window& window, const Volume& volume,
                     const QuantisedPose& pose, float voxel_size_m, MassUnits budget);

}  // namespace scree
