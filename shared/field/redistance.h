// Restores distances from the zero crossings outward, by the Eikonal equation |∇d| = 1
// (Godunov's upwind update: Rouy & Tourin 1992; Zhao 2005).
#pragma once

#include <cstdint>
#include <vector>

#include "shared/field/window.h"

namespace scree {

/// Redistances every voxel but those of the outermost layer and those next to a zero crossing, which keep
/// their codes. Interior seams, which cross no zero, vanish. At least three voxels a side.
void redistance(Window& window);

/// Writes the distances to the zero set of a function as codes. `levels` holds the function's values in the
/// window's order, negative inside; crossings stay where linear interpolation along the axes puts them. Every
/// voxel is redistanced.
void distances_from_levels(const std::vector<float>& levels, Window& window);

}  // namespace scree
