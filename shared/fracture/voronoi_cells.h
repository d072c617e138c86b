// Voronoi cells as convex polyhedra, for the cutters that work on polygons. Voxels; deterministic.
#pragma once

#include <vector>

#include "shared/fracture/polygon_mesh.h"

namespace scree {

/// The cell of each seed within the bounds. It has a face towards each neighbour, in the order of their
/// distances, and the remains of the bounds' six faces (`own_surface`). Cells fill the bounds without
/// overlap, except for rounding. Where seeds coincide the first has the cell and the others' are empty; so is
/// a cell that lies outside the bounds.
///
/// Each cell is the box cut by the bisectors with the other seeds, nearest first, until the rest are farther
/// than twice its farthest corner (as Rycroft 2009, "Voro++").
std::vector<PolygonMesh> voronoi_cells(const std::vector<glm::vec3>& seeds, const PolygonBounds& bounds);

}  // namespace scree
