// Distances in air that are true for what lies around, for rays that take them as steps. No GL in here.
#pragma once

#include "shared/field/window.h"

namespace scree {

/// Samples beyond a box that decide what lower_air() makes of those in it: a band's width.
inline constexpr int air_reach = 3;

/// Lowers every code of air to what the samples around allow: one of them, and the way to it. Coarse samples
/// are of two kinds, which know nothing of each other: generated ones, and those of edits (level_bricks.h).
void lower_air(Window& window);

}  // namespace scree
