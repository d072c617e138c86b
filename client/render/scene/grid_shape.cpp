#include "client/render/scene/grid_shape.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "client/render/scene/limits.h"

namespace scree {
namespace {

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

std::string_view name_of(GridSpacing spacing) {
  return spacing == GridSpacing::uniform ? "uniform" : "growing";
}

std::optional<GridSpacing> grid_spacing_named(std::string_view name) {
  for (const GridSpacing spacing : grid_spacings)
    if (name_of(spacing) == name) return spacing;
  return std::nullopt;
}

bool is_valid(const GridShape& shape) {
  return shape.resolution >= limits::grid_resolution_min && shape.resolution <= limits::grid_resolution_max &&
         shape.resolution % limits::grid_resolution_step == 0 && shape.scale >= 1 &&
         shape.scale <= limits::grid_scale_max && std::has_single_bit(static_cast<unsigned>(shape.scale));
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
