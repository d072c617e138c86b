// Recombination by stamp: a piece's posed volume becomes terrain again.
//
// terrain := terrain ∪ (volume, its iso-level shifted), gaps of less than a voxel closed, interior seams
// filled, the neighbourhood redistanced. Plain min/max loses 5 % of the volume over 50 cycles; each of these
// steps earns its place (docs/architecture.md, Recombine).
#pragma once

#include "shared/field/piece.h"

namespace scree {

/// Iso-level shifts are multiples of 1/2048 voxel, at most one voxel; positive grows the piece. Much finer
/// than a code: voxels round at different shifts, so the mass can be met to a few units.
inline constexpr float stamp_shift_steps_per_voxel = 2048.0F;
inline constexpr int stamp_shift_max = 2048;

/// The voxels that stamping may read; all that it may change lie at least one voxel inside.
VoxelBox stamp_box(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// `window` must cover stamp_box.
void stamp(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m, int shift);

struct StampPlan {
  int shift = 0;
  MassUnits gain = 0;  ///< what the window gains with that shift
};

/// The largest shift found whose gain stays within `budget`, and the exact gain of stamp()
/// with it. Only where old seams in the window are worth more than the budget is the gain above it, with the
/// least shift.
StampPlan plan_stamp(const Window& window, const Volume& volume, const QuantisedPose& pose,
                     float voxel_size_m, MassUnits budget);

}  // namespace scree
