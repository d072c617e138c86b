// How vertices, bricks on the GPU and shaders say which material shows at a place: a number of paint_bits
// bits. 0: the looks of weathered, broken or piled rock. Else 1 + the material, everywhere; or, with
// paint_in_cuts added, as far as a cut lays fresh rock bare. The shaders' side is material_source.h.
#pragma once

#include <cstdint>
#include <optional>

#include "shared/field/material.h"

namespace scree {

inline constexpr unsigned paint_material_bits = 4;
inline constexpr uint8_t paint_in_cuts = 1U << paint_material_bits;
inline constexpr unsigned paint_bits = paint_material_bits + 1;
static_assert(kind_count<Material> < paint_in_cuts, "more materials than paint_material_bits can tell");

/// Of a brick painted with the material, if it is painted.
constexpr uint8_t paint_number(std::optional<Material> paint) {
  return paint ? static_cast<uint8_t>(1 + static_cast<int>(*paint)) : uint8_t{0};
}

/// Of a layer that shows where a cut lays it bare. A cut through rock shows fresh rock, which is no paint.
constexpr uint8_t layer_number(Material layer) {
  return layer == Material::rock ? uint8_t{0} : static_cast<uint8_t>(paint_number(layer) | paint_in_cuts);
}

}  // namespace scree
