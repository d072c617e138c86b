// Recombination by progressive slices, the paper's way (section 2.4; Eisemann & Décoret 2008).
//
// The piece's polygons, as surface nets draw them, are cut into slices, one a layer of voxels. A pixel of a
// slice is rock when a ray from it leaves the piece through an odd number of polygons. Crossings are counted
// in integers (vertices on multiples of 1/256 voxel), so that no ray slips between two triangles.
//
// The slices are a density, 1 in rock and 0 in air. The surface lies where the density equals an iso-level;
// the choice of the iso-level, the shift, meets the mass. The slices are united with the terrain, and the
// neighbourhood is redistanced. The surfaces have steps of a voxel.
#pragma once

#include "shared/field/piece.h"
#include "shared/recombine/stamp_plan.h"

namespace scree {

/// The voxels of `box` in the posed piece: 1 for a pixel that is rock, else 0; window order.
std::vector<uint8_t> draw_slices(const Volume& volume, const QuantisedPose& pose, float voxel_size_m,
                                 const VoxelBox& box);

/// Between a pixel of rock and one of air, the surface runs in the middle at shift 0, through the pixel of
/// rock at −stamp_shift_max, and through that of air at stamp_shift_max. Each voxel's code steps at a
/// different shift, so that the mass changes in small steps. At −stamp_shift_max nothing changes. `window`
/// must cover stamp_box().
void stamp_slices(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m,
                  int shift);

/// Plans like plan_stamp(), but the gain never exceeds a budget that is not negative.
StampPlan plan_slices(const Window& window, const Volume& volume, const QuantisedPose& pose,
                      float voxel_size_m, MassUnits budget, const MergeFills& fills = {});

}  // namespace scree
