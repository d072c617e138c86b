// An edited brick as a value: what a field holds of it, and a wire or a file carries.
#pragma once

#include <optional>

#include "shared/field/brick.h"
#include "shared/field/coord.h"
#include "shared/field/material.h"

namespace scree {

/// A brick's codes and paint.
struct BrickPatch {
  BrickCoord coord;
  Brick brick;
  std::optional<Material> paint = std::nullopt;
};

}  // namespace scree
