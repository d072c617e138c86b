// The ways in which a piece can become terrain again, behind one door.
#pragma once

#include "shared/recombine/stamp.h"

namespace scree {

/// The voxels that a stamp by this method may read and change, whatever its shift.
VoxelBox stamp_box(StampMethod method, const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// `window` must cover the stamp's box; the shift within ± stamp_shift_max.
void stamp(StampMethod method, Window& window, const Volume& volume, const QuantisedPose& pose,
           float voxel_size_m, int shift);

/// The shift whose gain comes nearest the budget without exceeding it, and that gain, exactly. See each
/// method's own plan.
StampPlan plan_stamp(StampMethod method, const Window& window, const Volume& volume,
                     const QuantisedPose& pose, float voxel_size_m, MassUnits budget);

}  // namespace scree
