// Voronoi cells as convex polyhedra, for the cutters that work on polygons. Voxels; deterministic.
#pragma once

#include <vector>

#include "shared/fracture/polygon_mesh.h"

namespace scree {

/// The cell of each seed within the bounds: a face each towards its neighbours, in the order of their
/// distances, and what is left of the six of the bounds (`own_surface`). Cells fill the bounds without
/// overlap, but for rounding. Of seeds that coincide the first has the cell, the others' are empty; so is the
/// cell of a seed whose every place in the bounds is nearer to others.
///
/// Each cell is the box cut by the bisectors with the other seeds, nearest first, until the rest are farther
/// than twice its farthest corner (as Rycroft 2009, "Voro++").
std::vector<PolygonMesh> voronoi_cells(const std::vector<glm::vec3>& seeds, const PolygonBounds& bounds);

}  // namespace scree
