#include "shared/surface/placed_sheets.h"

#include <algorithm>

#include "shared/base/check.h"
#include "shared/surface/surface_cells.h"

namespace scree {
namespace {

/// The sheet's crossings, in the order in which surface_nets sums them.
std::vector<LeafCrossing> crossings_of(const Window& window, const CrossedSheet& sheet, VoxelCoord cell) {
  const CellTables& tables = cell_tables();
  std::vector<LeafCrossing> crossings;
  const auto code_at = [&](int i) {
    const VoxelCoord p = cell + cell_corner(i);
    return static_cast<float>(window.at(p.x, p.y, p.z));
  };
  for (size_t e = 0; e < cell_edges; ++e) {
    if (((sheet.edges >> e) & 1U) == 0) continue;
    const auto axis = static_cast<int>(e / 4);
    const VoxelCoord from = cell_corner(tables.edges[e].from);
    const float a = code_at(tables.edges[e].from), b = code_at(tables.edges[e].to);
    CHECK_DEBUG((a < 0.0F) != (b < 0.0F));
    glm::vec3 at(static_cast<float>(from.x), static_cast<float>(from.y), static_cast<float>(from.z));
    at[axis] += a / (a - b);
    crossings.push_back({at, axis});
  }
  return crossings;
}

}  // namespace

CellSteps steps_inside(glm::vec3 place, std::span<const CellSteps> sheets_before) {
  constexpr int side = surface_steps;
  CellSteps steps;
  for (size_t i = 0; i < 3; ++i) {
    const auto inner = static_cast<int>(place[static_cast<int>(i)] * surface_steps_per_voxel + 0.5F);
    steps[i] = std::clamp(inner, 1, side - 1);
  }
  // Some may have been moved into the same corner of the cell.
  const int away = place.x < 0.5F ? 1 : -1;
  while (std::ranges::find(sheets_before, steps) != sheets_before.end()) steps[0] += away;
  CHECK(steps[0] > 0 && steps[0] < side);
  return steps;
}

std::vector<PlacedVertex> placed_sheets(const Window& window, VoxelCoord origin,
                                        std::span<const CrossedSheet> sheets, const SheetPlace& place) {
  constexpr int side = surface_steps;
  std::vector<PlacedVertex> placed;
  placed.reserve(sheets.size());
  std::vector<CellSteps> in_cell;
  for (size_t i = 0; i < sheets.size(); ++i) {
    const CrossedSheet& sheet = sheets[i];
    if (i > 0 && sheets[i - 1].cell != sheet.cell) in_cell.clear();
    const VoxelCoord cell = origin + VoxelCoord{sheet.at[0], sheet.at[1], sheet.at[2]};
    const CellSteps steps = steps_inside(place(cell, crossings_of(window, sheet, cell)), in_cell);
    in_cell.push_back(steps);
    PlacedVertex& to = placed.emplace_back();
    to.cell = sheet.cell;
    for (size_t axis = 0; axis < 3; ++axis) {
      to.position[axis] = static_cast<uint16_t>(sheet.at[axis] * side + steps[axis]);
      to.fraction[static_cast<int>(axis)] = static_cast<float>(steps[axis]) / surface_steps_per_voxel;
    }
  }
  return placed;
}

}  // namespace scree
