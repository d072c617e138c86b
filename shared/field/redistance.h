// Restores distances from the zero crossings outward, by the Eikonal equation |∇d| = 1
// (Godunov's upwind update: Rouy & Tourin 1992; Zhao 2005).
#pragma once

#include <cstdint>
#include <vector>

#include "shared/field/window.h"

namespace scree {

/// Redistances every voxel but the outermost layer of the window and those next to a zero crossing, which
/// stay as they are. Interior seams, which cross no zero, vanish.
void redistance(Window& window);

/// From any function's values f (window order, sign = side), codes that are distances to its zero set; the
/// crossings stay where linear interpolation along the axes puts them. Used by generate; reads all, all are
/// redistanced.
void distances_from_levels(const std::vector<float>& levels, Window& window);

}  // namespace scree
