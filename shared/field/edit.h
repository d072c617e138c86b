// Carve, fill and extract: constructive solid geometry on windows of codes (paper, sections 2.2 and 2.3).
// All windows of one call have the same box. Lengths in voxels.
#pragma once

#include "shared/field/shape.h"
#include "shared/field/window.h"

namespace scree {

/// The shape's distances over a box, as codes. The shape is in voxels (in_voxels).
Window codes_of(const Shape& shape_voxels, const VoxelBox& box);

/// window := window − shape. Distances outside stay lower bounds of the true ones.
void carve(Window& window, const Window& shape);

/// window := window ∪ shape.
void fill(Window& window, const Window& shape);

/// window ∩ shape: the solid that a carve with the same shape takes out.
Window extract(const Window& window, const Window& shape);

}  // namespace scree
