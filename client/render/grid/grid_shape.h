// The grid of points that the method grid draws the terrain by: the paper's, section 2.2, with the spacing
// that grows outwards which it proposes. No GL.
//
// The grid follows the eye by whole blocks, and every point lies at a multiple of the spacing around it, so
// that the surface does not swim when the eye moves. All axes have the same coordinates relative to the
// centre, so that cells are boxes without hanging corners: the surface has no crack, whatever the spacing.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "client/render/scene/draw_option.h"
#include "shared/base/kind_table.h"

namespace scree {

enum class GridSpacing : uint8_t { uniform = 0, growing = 1 };

struct GridSpacingRow {
  std::string_view name;
};

constexpr GridSpacingRow row_of(GridSpacing spacing) {
  switch (spacing) {
    case GridSpacing::uniform:
      return {.name = "uniform"};
    case GridSpacing::growing:
      return {.name = "growing"};
  }
  return {};
}

struct GridShape {
  int resolution = 128;  ///< cells along a side
  int scale = 2;         ///< voxels between two points about the eye
  GridSpacing spacing = GridSpacing::uniform;

  bool operator==(const GridShape&) const = default;
};

/// The options of the method grid, and the shape that their values give.
std::span<const DrawOption> grid_options();
GridShape grid_shape_of(const DrawOptionValues& values);
/// The values that give this shape, which must be one that the options allow.
DrawOptionValues values_of(const GridShape& shape);

/// Cells along a side of a block; the grid moves by whole blocks.
inline constexpr int grid_block = 8;

/// Number of spacings when the spacing grows, each twice the one before.
inline constexpr int grid_shells = 4;

/// Coordinates of the points along one axis, resolution + 1 of them, voxels. When the spacing grows, the
/// inner half of the cells has the finest; then it doubles after each sixth, or a little later, at a multiple
/// of the next spacing.
std::vector<int> grid_line(const GridShape& shape, float eye_voxels);

/// Least distance from the eye to the grid's border, voxels.
int grid_reach(const GridShape& shape);

}  // namespace scree
