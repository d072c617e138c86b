#include "client/render/grid/grid_shape.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "client/render/grid/limits.h"

namespace scree {
namespace {

constexpr auto resolutions = [] {
  constexpr int steps =
      (limits::grid_resolution_max - limits::grid_resolution_min) / limits::grid_resolution_step;
  std::array<int, steps + 1> values{};
  for (int i = 0; i <= steps; ++i)
    values[static_cast<size_t>(i)] = limits::grid_resolution_min + i * limits::grid_resolution_step;
  return values;
}();

constexpr auto scales = [] {
  std::array<int, std::bit_width(static_cast<unsigned>(limits::grid_scale_max))> values{};
  for (size_t i = 0; i < values.size(); ++i) values[i] = 1 << i;
  return values;
}();

constexpr auto spacings = [] {
  std::array<int, kind_count<GridSpacing>> values{};
  for (size_t i = 0; i < values.size(); ++i) values[i] = static_cast<int>(all_kinds<GridSpacing>[i]);
  return values;
}();

/// In the order of GridShape's members.
constexpr std::array options{DrawOption{.name = "grid-resolution",
                                        .label = "grid cells",
                                        .unit = "a side",
                                        .help = "For grid: cells along a side",
                                        .values = resolutions,
                                        .names = {},
                                        .usual = GridShape().resolution},
                             DrawOption{.name = "grid-scale",
                                        .label = "spacing",
                                        .unit = "voxels",
                                        .help = "For grid: voxels between two points",
                                        .values = scales,
                                        .names = {},
                                        .usual = GridShape().scale},
                             DrawOption{.name = "grid-spacing",
                                        .label = "",
                                        .unit = "",
                                        .help = "For grid: spacing of the points, the same everywhere or "
                                                "growing with the distance from the camera",
                                        .values = spacings,
                                        .names = kind_names<GridSpacing>,
                                        .usual = static_cast<int>(GridShape().spacing)}};

/// Points after the centre, in units of the scale; the centre is a multiple of all spacings.
std::vector<int> half_line(const GridShape& shape) {
  const int cells = shape.resolution / 2;
  std::vector<int> points;
  int at = 0, spacing = 1, in_shell = 0;
  for (int i = 0; i < cells; ++i) {
    const bool may_grow = shape.spacing == GridSpacing::growing && spacing < 1 << (grid_shells - 1);
    const int enough = spacing == 1 ? cells / 2 : cells / 2 / (grid_shells - 1);
    if (may_grow && in_shell >= enough && at % (2 * spacing) == 0) {
      spacing *= 2;
      in_shell = 0;
    }
    at += spacing;
    ++in_shell;
    points.push_back(at);
  }
  return points;
}
static_assert(grid_block % (1 << (grid_shells - 1)) == 0);

}  // namespace

std::span<const DrawOption> grid_options() {
  return options;
}

GridShape grid_shape_of(const DrawOptionValues& values) {
  const auto& [resolution, scale, spacing] = options;
  return {values.of(resolution), values.of(scale), static_cast<GridSpacing>(values.of(spacing))};
}

DrawOptionValues values_of(const GridShape& shape) {
  const auto& [resolution, scale, spacing] = options;
  DrawOptionValues values;
  values.set(resolution, shape.resolution);
  values.set(scale, shape.scale);
  values.set(spacing, static_cast<int>(shape.spacing));
  return values;
}

std::vector<int> grid_line(const GridShape& shape, float eye_voxels) {
  const int step = grid_block * shape.scale;
  const int centre = static_cast<int>(std::lround(eye_voxels / static_cast<float>(step))) * step;
  const std::vector<int> half = half_line(shape);
  std::vector<int> line{centre};
  for (const int point : half) line.push_back(centre + point * shape.scale);
  for (const int point : half) line.push_back(centre - point * shape.scale);
  std::ranges::sort(line);
  return line;
}

int grid_reach(const GridShape& shape) {
  return (half_line(shape).back() - grid_block / 2) * shape.scale;
}

}  // namespace scree
