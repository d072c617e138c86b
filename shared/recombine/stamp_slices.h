// Recombination by progressive slices, the paper's way (section 2.4; Eisemann & Décoret 2008).
//
// The piece's polygons, as surface nets draw them, are cut into slices, one a layer of voxels. A pixel of a
// slice is rock when a ray from it leaves the piece through an odd number of polygons. Crossings are counted
// in integers (vertices on multiples of 1/256 voxel), so that no ray slips between two triangles.
//
// The slices are a density of 1 in rock and 0 in air, between which the surface lies where the density is
// that of the iso-level: with which the mass is met. They are united with the terrain, and the neighbourhood
// is redistanced. Surfaces come out in steps of a voxel.
#pragma once

#include "shared/recombine/stamp.h"

namespace scree {

/// The voxels of `box` in the posed piece: 1 for a pixel that is rock, else 0; window order.
std::vector<uint8_t> draw_slices(const Volume& volume, const QuantisedPose& pose, float voxel_size_m,
                                 const VoxelBox& box);

/// The surface runs between a pixel of rock and one of air in the middle at shift 0, along the one of rock at
/// −stamp_shift_max and along the one of air at stamp_shift_max; each voxel rounds at a shift of its own. At
/// −stamp_shift_max exactly nothing changes. `window` must cover stamp_box.
void stamp_slices(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m,
                  int shift);

/// As plan_stamp, but the gain never exceeds a budget that is not negative.
StampPlan plan_slices(const Window& window, const Volume& volume, const QuantisedPose& pose,
                      float voxel_size_m, MassUnits budget);

}  // namespace scree
