// An edited brick as a value: what a field holds of it, and a wire or a file carries.
#pragma once

#include "shared/field/brick.h"
#include "shared/field/brick_materials.h"
#include "shared/field/coord.h"

namespace scree {

/// A brick's codes, and what its voxels say of their materials.
struct BrickPatch {
  BrickCoord coord;
  Brick brick;
  BrickMaterials materials{};
};

}  // namespace scree
