// Recombination by stamp: a piece's posed volume becomes terrain again.
//
// terrain := terrain ∪ volume; gaps between the two closed, interior seams filled, the neighbourhood
// redistanced. A sampled piece is too heavy at its convex edges, by up to 15 %, and a pile too light in its
// clefts: so the mass is met there first, by rounding edges or filling clefts, and only what that cannot hold
// by moving the whole surface. Pieces merged where they were thus restore the surface that they had (bench
// seams; docs/architecture.md, Recombine).
#pragma once

#include "shared/field/piece.h"

namespace scree {

/// How a piece becomes terrain again: `stamp` as above; `slices` and `sphere`: the paper's method, and what
/// its program did (stamp_slices.h, stamp_sphere.h). It decides bits, so it crosses the wire.
enum class StampMethod : uint8_t { stamp = 0, slices = 1, sphere = 2 };

/// How far to round edges (negative) or to fill clefts (positive): all the way at ± half of the maximum;
/// beyond it the whole surface moves, by up to half a voxel at the maximum. Each voxel rounds at a shift of
/// its own, so that the mass can be met to a few units. 14 bits: two bytes on the wire.
inline constexpr int stamp_shift_max = 8191;

/// The voxels that stamping may read; all that it may change lie at least one voxel inside.
VoxelBox stamp_box(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// `window` must cover stamp_box.
void stamp(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m, int shift);

/// What a merge may gain: the piece's mass, and of the dust waiting no more than a thirty-second of that, for
/// a piece that takes much more bulges (measured: bench seams).
inline MassUnits stamp_budget(MassUnits piece_mass, MassUnits dust) {
  const MassUnits most = piece_mass / 32;
  return piece_mass + (dust < most ? dust : most);
}

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
