// The cutter `slice`: the paper's recursive mesh slicing (1.2.2, 2.3). Voxels; deterministic.
#pragma once

#include <vector>

#include "shared/fracture/polygon_cut.h"
#include "shared/fracture/polygon_mesh.h"

namespace scree {

/// The closed part of a closed mesh in each cell (voronoi_cells.h): the mesh is cut by the planes of the
/// cell's faces, one after the other, and each hole is capped. The paper cuts every cell from the whole mesh;
/// here the cells are halved recursively, and each half begins with the mesh around it, so that the cost does
/// not grow with the product of mesh and cells.
std::vector<PolygonMesh> slice_by_cells(const PolygonMesh& mesh, const std::vector<PolygonMesh>& cells);

inline constexpr PolygonCutting slice_cutting{.parts = slice_by_cells, .closed = true};

}  // namespace scree
