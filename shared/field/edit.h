// Carve, fill and extract: constructive solid geometry on windows of codes (paper, sections 2.2 and 2.3).
// Shapes are in voxels (in_voxels). Outside what they touch the window is left alone.
#pragma once

#include "shared/field/shape.h"
#include "shared/field/window.h"

namespace scree {

/// window := window − shape. Keeps the field a lower bound of the distance outside.
void carve(Window& window, const Shape& shape_voxels);

/// window := window ∪ shape.
void fill(Window& window, const Shape& shape_voxels);

/// window ∩ shape: what a carve of the same shape would take out.
Window extract(const Window& window, const Shape& shape_voxels);

}  // namespace scree
