// Recombination by stamp: a piece's posed volume becomes terrain again.
//
// terrain := terrain ∪ volume; gaps between the two closed, interior seams filled, the neighbourhood
// redistanced. A sampled piece is too heavy at its convex edges, by up to 15 %, and a pile is too light in
// its clefts. So the mass is met there first, by rounding edges or filling clefts. Moving the whole surface
// meets the remaining mass. Moving voxels by single codes, all over the surface, meets the last units. Pieces
// merged where they were thus restore the surface that they had (bench seams; docs/design/simulation.md).
#pragma once

#include <cstdint>
#include <string_view>

#include "shared/base/kind_table.h"
#include "shared/field/piece.h"

namespace scree {

/// The method by which a piece becomes terrain again: `stamp` as above; `slices`, the paper's; `sphere`, that
/// of the paper's program (stamp_slices.h, stamp_sphere.h). `facets`: a stamp whose piece is read by planes
/// (posed_piece.h), and which meets the mass by moving the whole surface alone: stones keep flat faces and
/// their edges, and gaps between them, where `stamp` restores a surface that was cut. It decides bits, so it
/// crosses the wire.
enum class StampMethod : uint8_t { stamp = 0, slices = 1, sphere = 2, facets = 3 };

struct StampMethodRow {
  std::string_view name;
  bool lays;  ///< it is made of lay() and stamp_laid(), so that several pieces may merge at once
};

constexpr StampMethodRow row_of(StampMethod method) {
  switch (method) {
    case StampMethod::stamp:
      return {.name = "stamp", .lays = true};
    case StampMethod::slices:
      return {.name = "slices", .lays = false};
    case StampMethod::sphere:
      return {.name = "sphere", .lays = false};
    case StampMethod::facets:
      return {.name = "facets", .lays = true};
  }
  return {};
}

/// Whether several pieces may merge at once by this method, which must be known.
constexpr bool lays(StampMethod method) {
  return traits_of(method).lays;
}

/// Bounds of a shift, whose meaning is the method's: 14 bits on the wire.
inline constexpr int stamp_shift_max = 8191;

/// The method stamp's shift holds two numbers, roundness · 2^7 + dust. A negative roundness
/// rounds edges, a positive one fills clefts. Up to half of the maximum the effect grows until it is
/// complete; beyond, the whole surface moves as well, by up to half a voxel at the maximum. By `facets` the
/// surface alone moves, as far.
inline constexpr int stamp_roundness_max = 63;
/// The dust that the piece takes along, in steps of stamp_dust_step units.
inline constexpr int stamp_dust_bits = 7;
inline constexpr int stamp_dust_step = 16;

/// The voxels that stamping the piece may read.
VoxelBox stamp_box(const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// The piece on the terrain's grid: the voxels that may become rock, and a layer around them. Here and below
/// the method is one that lays.
Window lay(StampMethod method, const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// One window over all of the pieces' windows, with the least of their codes at each voxel.
Window together(std::vector<Window> laid);

/// The voxels that stamping a laid piece reads; those that it may change lie at least one voxel inside.
VoxelBox merge_box(const Window& laid);

/// Merges a laid piece into `window`, the terrain over merge_box(laid), with a given shift.
void stamp_laid(StampMethod method, Window& window, const Window& laid, MassUnits piece_mass, int shift);

struct StampPlan {
  int shift = 0;
  MassUnits gain = 0;  ///< mass that the window gains with that shift
};

/// Plans like plan_stamp() and leaves the stamped terrain in `window`, which has the box merge_box(laid).
StampPlan plan_laid(StampMethod method, Window& window, const Window& laid, MassUnits piece_mass,
                    MassUnits budget);

/// Merges a piece into `window`, which must cover stamp_box(). The window gains the piece's mass and the
/// shift's dust, as nearly as single codes allow at the shift's roundness. The method is one that lays.
void stamp(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m, int shift,
           StampMethod method = StampMethod::stamp);

/// Mass that a merge may gain: the piece's, and of the waiting dust at most a thirty-second of that, as a
/// piece that takes much more bulges (measured: bench seams).
inline MassUnits stamp_budget(MassUnits piece_mass, MassUnits dust) {
  const MassUnits most = piece_mass / 32;
  return piece_mass + (dust < most ? dust : most);
}

/// Finds the shift whose gain comes nearest the budget (the piece's mass and dust), within a few units where
/// the piece can hold that much; and the exact gain of stamp() with this shift. The gain exceeds the budget
/// only where gaps between earlier merges, which redistancing closes, alone gain more than the budget.
StampPlan plan_stamp(const Window& window, const Volume& volume, const QuantisedPose& pose,
                     float voxel_size_m, MassUnits budget, StampMethod method = StampMethod::stamp);

}  // namespace scree
