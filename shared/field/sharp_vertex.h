// The vertex of dual contouring (Ju et al. 2002): where the planes at a sheet's crossings meet best, so that
// edges and corners of the rock stay sharp. Pure, safe from any thread.
#pragma once

#include <span>

#include "shared/field/leaf_surface.h"
#include "shared/field/window.h"

namespace scree {

/// In sides of the leaf from its lowest corner; may lie outside of the leaf. `window` holds the codes of the
/// leaf's own level, whose corners lie at `cell` and one further; two more beyond it on every side. Least
/// squares by a Jacobi eigensolver of our own, from the mean of the crossings; directions that the planes do
/// not fix are left alone.
///
/// The planes are fitted to the codes around the crossings' lattice points that agree with one another. What
/// limits the edges: a leaf of which one face has but a corner, a code's 3/127 voxel, and features closer to
/// one another than three voxels.
glm::vec3 sharp_vertex(const Window& window, VoxelCoord cell, std::span<const LeafCrossing> crossings);

}  // namespace scree
