// Recombination by a sphere, the method of the paper's own program (section 4.1): a ball of terrain around
// the place where the fragment's centre of mass came to rest, whatever its shape.
//
// The paper does not give the ball's size. Here the ball has the piece's volume, and grows where the ground
// already fills a part of it, until the terrain gains the piece's mass; the mass that the largest ball cannot
// hold becomes dust.
#pragma once

#include "shared/field/piece.h"
#include "shared/recombine/stamp_plan.h"

namespace scree {

/// The voxels that stamping the ball may read and change, at any shift.
VoxelBox stamp_sphere_box(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// Adds the ball to `window`, which must cover stamp_sphere_box(). Its radius is that of a ball of the
/// piece's volume at shift 0, half as much again at stamp_shift_max, and zero at −stamp_shift_max, where
/// nothing changes.
void stamp_sphere(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m,
                  int shift);

/// Plans like plan_stamp(), but the gain never exceeds a budget that is not negative.
StampPlan plan_sphere(const Window& window, const Volume& volume, const QuantisedPose& pose,
                      float voxel_size_m, MassUnits budget, const MergeFills& fills = {});

}  // namespace scree
