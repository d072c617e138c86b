// Vertices of surface_nets at places that someone names, instead of the means of their crossings.
// Pure, safe from any thread.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/surface/leaf_surface.h"
#include "shared/surface/surface_vertices.h"

namespace scree {

/// Where the vertex of a sheet lies that crosses the edges of the cell there: as LeafRules::place() says.
using SheetPlace = std::function<glm::vec3(VoxelCoord cell, std::span<const LeafCrossing> crossings)>;

/// `origin` is the mesh's. Of each cell, its sheets follow one another.
std::vector<PlacedVertex> placed_sheets(const Window& window, VoxelCoord origin,
                                        std::span<const CrossedSheet> sheets, const SheetPlace& place);

/// 1/256 of the cell's side from its lowest corner, strictly inside, so that two cells' vertices never
/// coincide; nor do those of sheets of one cell, of which this one has that many before it.
using CellSteps = std::array<int, 3>;
CellSteps steps_inside(glm::vec3 place, std::span<const CellSteps> sheets_before);

}  // namespace scree
