// A fill whose face lies exactly on the terrain's surface. Where that is a plane of voxels, both have the
// code of the surface there: no voxel is solid, nothing connects the two, and half of a voxel's mass is
// missing between them. A joint closes this: a slab of one voxel, half of it in the fill and half in the
// terrain. Metres.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/field/field.h"
#include "shared/field/shape.h"

namespace scree {

/// The shape, which is to be filled, and before it the joints that it needs by rules::joints: one for each
/// face of a box that touches so. Those that are too small for a fill are left out.
std::vector<Shape> with_joints(const Shape& shape, Field& field, uint32_t by_rules);

}  // namespace scree
