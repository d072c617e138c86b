// Vertices of surface_nets at places that the caller chooses, instead of the means of their crossings. Pure,
// safe from any thread.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/surface/leaf_surface.h"
#include "shared/surface/surface_vertices.h"

namespace scree {

/// Returns the place of a sheet's vertex, given the sheet's crossings; the same contract as
/// LeafRules::place().
using SheetPlace = std::function<glm::vec3(VoxelCoord cell, std::span<const LeafCrossing> crossings)>;

/// Places the vertices of sheets. `origin` is the mesh's; the sheets of one cell must follow one another.
std::vector<PlacedVertex> placed_sheets(const Window& window, VoxelCoord origin,
                                        std::span<const CrossedSheet> sheets, const SheetPlace& place);

/// A place in a cell, in 1/256 of its side from its lowest corner.
using CellSteps = std::array<int, 3>;
/// The steps of a place, moved strictly inside the cell, so that vertices of two cells never coincide, and
/// away from those of the cell's earlier sheets.
CellSteps steps_inside(glm::vec3 place, std::span<const CellSteps> sheets_before);

}  // namespace scree
