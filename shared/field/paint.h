// Bricks painted with a material, over what the generator's layers say. Paint stays where it is: what a carve
// takes out keeps it as the pieces' material, what is poured or merged into a painted brick takes it on.
#pragma once

#include <vector>

#include "shared/field/field.h"
#include "shared/field/shape.h"

namespace scree {

/// A shape (voxels) rounded to bricks: those whose centres lie in it, and the one that holds its own centre.
/// In order.
std::vector<BrickCoord> bricks_of(const Shape& shape_voxels);

/// The voxels of those bricks, and of what lies between them.
VoxelBox paint_box(const Shape& shape_voxels);

/// Returns the bricks that were of another paint before, in order.
std::vector<BrickCoord> paint(Field& field, const Shape& shape_voxels, Material material);

/// What the terrain is made of at a place (metres): what its brick is painted, else as generated.
Material material_at(const Field& field, glm::vec3 p_m);

}  // namespace scree
