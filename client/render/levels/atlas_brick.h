// A brick as the raymarcher's atlas holds it: 8³ voxels with an apron of their neighbours, so that trilinear
// samples and central differences need no neighbour. No GL in here.
//
// Samples are −1 … 9 along each axis: cells 0 … 7 need sample 8, differences over ±1 voxel −1 and 9.
#pragma once

#include <array>
#include <cstdint>

#include "shared/field/brick.h"

namespace scree {

inline constexpr int atlas_apron_low = 1;
inline constexpr int atlas_brick_side = 11;

/// Codes of one brick and its apron, z fastest, as in a Window of that size.
using AtlasBrick = std::array<Code, atlas_brick_side * atlas_brick_side * atlas_brick_side>;

/// Where a brick lies, in bricks along the texture's axes. The texture's x runs along the field's z.
struct AtlasSlot {
  uint8_t x = 0;
  uint8_t y = 0;
  uint8_t z = 0;

  bool operator==(const AtlasSlot&) const = default;
};

}  // namespace scree
