// Painting whole bricks, as operations of the first recordings did. Paint stays in its bricks: what was
// poured into a painted brick took the paint's material.
#pragma once

#include <vector>

#include "shared/field/field.h"
#include "shared/field/shape.h"

namespace scree {

/// A shape (voxels) rounded to bricks: the bricks whose centres lie in the shape, and the brick that holds
/// the shape's centre. In order; never empty.
std::vector<BrickCoord> bricks_of(const Shape& shape_voxels);

/// The smallest box of voxels that holds those bricks.
VoxelBox paint_box(const Shape& shape_voxels);

/// Paints the shape's bricks, whole. Returns the bricks whose materials changed, in order.
std::vector<BrickCoord> paint_bricks(Field& field, const Shape& shape_voxels, Material material);

}  // namespace scree
