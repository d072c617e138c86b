// Palettes for tests.
#pragma once

#include <string>

#include "shared/material/palette.h"

namespace scree {

/// Rock under sand.
inline Palette small_palette() {
  Palette palette;
  palette.rows.resize(2);
  palette.rows[0].name = "rock";
  palette.rows[1].name = "sand";
  palette.ground = {Material{0}, Material{1}, Material{0}, 1.0F, 1.5F};
  return palette;
}

inline Palette palette_of(size_t rows) {
  Palette palette;
  palette.ground = {Material{0}, Material{0}, Material{0}, 1.0F, 1.5F};
  for (size_t i = 0; i < rows; ++i) {
    palette.rows.emplace_back();
    palette.rows.back().name = "m" + std::to_string(i);
  }
  return palette;
}

}  // namespace scree
