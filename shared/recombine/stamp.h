// Recombination by stamp: a piece's posed volume becomes terrain again.
//
// terrain := terrain ∪ volume; gaps between the two closed, interior seams filled, the neighbourhood
// redistanced. A sampled piece is too heavy at its convex edges, by up to 15 %, and a pile is too light in
// its clefts. So the mass is met there first, by rounding edges or filling clefts. Moving the whole surface
// meets the remaining mass. Moving voxels by single codes, all over the surface, meets the last units. Pieces
// merged where they were thus restore the surface that they had (bench seams; docs/design/simulation.md).
#pragma once

#include <vector>

#include "shared/field/piece.h"
#include "shared/recombine/merge_patch.h"
#include "shared/recombine/posed_piece.h"
#include "shared/recombine/stamp_plan.h"

namespace scree {

/// A way to merge by laying pieces on the terrain's grid first, so that several pieces may merge at once.
struct Laying {
  Reading reading;  ///< how a piece is read between its voxels
  Edges edges;      ///< what gives way to meet the mass
};
/// Restores a surface that was cut.
inline constexpr Laying laying_rounded{Reading::codes, Edges::round};
/// Stones keep flat faces and their edges, and gaps between them.
inline constexpr Laying laying_faceted{Reading::planes, Edges::sharp};

/// The shift of a stamp that rounds edges holds two numbers, roundness · 2^7 + dust. A negative roundness
/// rounds edges, a positive one fills clefts. Up to half of the maximum the effect grows until it is
/// complete; beyond, the whole surface moves as well, by up to half a voxel at the maximum. Where edges are
/// kept, the surface alone moves, as far.
inline constexpr int stamp_roundness_max = 63;
/// The dust that the piece takes along, in steps of stamp_dust_step units.
inline constexpr int stamp_dust_bits = 7;
inline constexpr int stamp_dust_step = 16;

/// The voxels that stamping the piece may read.
VoxelBox stamp_box(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// The piece on the terrain's grid: the voxels that may become rock, and a layer around them.
Window lay(const Laying& laying, const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// One window over all of the pieces' windows, with the least of their codes at each voxel.
Window together(std::vector<Window> laid);

/// The voxels that stamping a laid piece reads; those that it may change lie at least one voxel inside.
VoxelBox merge_box(const Window& laid);

/// Merges a laid piece into `window`, the terrain over merge_box(laid), with a given shift.
void stamp_laid(const Laying& laying, Window& window, const Window& laid, MassUnits piece_mass, int shift,
                const MergeFills& fills = {});

/// Plans like plan_stamp() and leaves the stamped terrain in `window`, which has the box merge_box(laid).
StampPlan plan_laid(const Laying& laying, Window& window, const Window& laid, MassUnits piece_mass,
                    MassUnits budget, const MergeFills& fills = {});

/// Merges a piece into `window`, which must cover stamp_box(). The window gains the piece's mass and the
/// shift's dust, as nearly as single codes allow at the shift's roundness.
void stamp(const Laying& laying, Window& window, const Volume& volume, const QuantisedPose& pose,
           float voxel_size_m, int shift);

/// Finds the shift whose gain comes nearest the budget (the piece's mass and dust), within a few units where
/// the piece can hold that much; and the exact gain of stamp() with this shift. The gain exceeds the budget
/// only where gaps between earlier merges, which redistancing closes, alone gain more than the budget.
StampPlan plan_stamp(const Laying& laying, const Window& window, const Volume& volume,
                     const QuantisedPose& pose, float voxel_size_m, MassUnits budget);

}  // namespace scree
