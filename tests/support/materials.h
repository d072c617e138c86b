// Materials of whole bricks, and those that the ground's layers are of.
#pragma once

#include <algorithm>
#include <array>

#include "content/builtin_palette.h"
#include "shared/field/brick_materials.h"

namespace scree {

inline BrickMaterials all_of(Material material) {
  return BrickMaterials(said(material));
}

inline constexpr std::array ground_layers{material::rock, material::soil, material::ice};

/// Rows that are no rubble.
inline size_t stones_of(const Palette& palette) {
  return static_cast<size_t>(
      std::ranges::count_if(palette.rows, [](const MaterialRow& row) { return !row.rubble; }));
}

inline const MaterialRow& builtin_row(Material material) {
  return builtin_palette().row(material);
}

}  // namespace scree
