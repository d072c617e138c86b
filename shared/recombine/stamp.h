// Recombination by stamp: a piece's posed volume becomes terrain again.
//
// terrain := terrain ∪ volume; gaps between the two closed, interior seams filled, the neighbourhood
// redistanced. A sampled piece is too heavy at its convex edges, by up to 15 %, and a pile too light in its
// clefts: so the mass is met there first, by rounding edges or filling clefts, and only what that cannot hold
// by moving the whole surface; the last units by moving voxels by single codes, all over it. Pieces merged
// where they were thus restore the surface that they had (bench seams; docs/architecture.md, Recombine).
#pragma once

#include "shared/field/piece.h"

namespace scree {

/// How a piece becomes terrain again: `stamp` as above; `slices` and `sphere`: the paper's method, and what
/// its program did (stamp_slices.h, stamp_sphere.h). It decides bits, so it crosses the wire.
enum class StampMethod : uint8_t { stamp = 0, slices = 1, sphere = 2 };

/// Bounds of a shift, whose meaning is the method's: 14 bits on the wire.
inline constexpr int stamp_shift_max = 8191;

/// The stamp's shift is two numbers, roundness · 2^7 + dust. How far to round edges (negative) or to fill
/// clefts (positive): all the way at ± half of the maximum; beyond it the whole surface moves, by up to half
/// a voxel at the maximum.
inline constexpr int stamp_roundness_max = 63;
/// And the dust that it takes along, in steps of so many units.
inline constexpr int stamp_dust_bits = 7;
inline constexpr int stamp_dust_step = 16;

/// The voxels that stamping may read.
VoxelBox stamp_box(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// The piece on the terrain's grid: the voxels that may become rock, and a layer around them.
Window lay(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// The pieces' windows as one: the least of their codes.
Window together(std::vector<Window> laid);

/// The voxels around such a piece that stamping it reads; all that it may change lie at least one voxel
/// inside.
VoxelBox merge_box(const Window& laid);

/// `window` is the terrain in merge_box(laid), united with the piece as that shift says.
void stamp_laid(Window& window, const Window& laid, MassUnits piece_mass, int shift);

struct StampPlan {
  int shift = 0;
  MassUnits gain = 0;  ///< what the window gains with that shift
};

/// As plan_stamp, and does it.
StampPlan plan_laid(Window& window, const Window& laid, MassUnits piece_mass, MassUnits budget);

/// `window` must cover stamp_box. It gains the piece's mass and the dust, as near as single codes come from
/// that roundness.
void stamp(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m, int shift);

/// What a merge may gain: the piece's mass, and of the dust waiting no more than a thirty-second of that, for
/// a piece that takes much more bulges (measured: bench seams).
inline MassUnits stamp_budget(MassUnits piece_mass, MassUnits dust) {
  const MassUnits most = piece_mass / 32;
  return piece_mass + (dust < most ? dust : most);
}

/// The shift with which the gain is the piece's mass and of what the budget holds beyond it all but the last
/// few units, or as near to that as can be; and the exact gain of stamp() with it. Only where old seams in
/// the window are worth more than the budget is the gain above it.
StampPlan plan_stamp(const Window& window, const Volume& volume, const QuantisedPose& pose,
                     float voxel_size_m, MassUnits budget);

}  // namespace scree
