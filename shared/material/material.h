// What terrain and pieces are made of, as a number: a row of the world's palette (palette.h).
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree {

/// A row of a palette: 0 … materials_max − 1. Kernels compare these numbers, and never ask what they stand
/// for: so the palette's other numbers may change in a running world.
enum class Material : uint8_t {};

/// Rows of a palette at most: of a byte's 256 values one says "the ground's own" (brick_materials.h).
inline constexpr size_t materials_max = 255;

constexpr size_t row_number(Material material) {
  return static_cast<size_t>(material);
}

/// Mass of a full voxel of a material without pores. Stones of rubble fill a part of it.
inline constexpr int fill_solid = 128;

/// The rows that the ground's layers are of where no palette says other ones: the first of the built-in one.
namespace material {
inline constexpr Material rock{0}, soil{1}, ice{2};
}

/// What unedited ground is made of: bulk, soil below one height, and a cap above another (MaterialHeights).
/// Part of what a world is: it decides the ground's materials, bit by bit, and never changes.
struct GroundRows {
  Material bulk = material::rock;
  Material soil = material::soil;
  Material cap = material::ice;
  float soil_depth_m = 1.0F;  ///< how deep the layers reach below the undisturbed surface
  float cap_depth_m = 1.5F;

  bool operator==(const GroundRows&) const = default;
};

}  // namespace scree
