// Bricks painted with a material, which takes precedence over the generator's layers. Paint stays in its
// bricks: pieces carved out of a painted brick are of that material, and material poured or merged into a
// painted brick takes the paint's.
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

/// Paints the shape's bricks. Returns the bricks whose paint changed, in order.
std::vector<BrickCoord> paint(Field& field, const Shape& shape_voxels, Material material);

/// The terrain's material at a place (metres): the paint of its brick, else the generated layer.
Material material_at(const Field& field, glm::vec3 p_m);

}  // namespace scree
