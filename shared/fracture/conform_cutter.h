// The cutter `conform`: Voronoi cells bounded by the shape itself, without recursive slicing (paper, 1.2.2).
// Voxels; deterministic.
#pragma once

#include <vector>

#include "shared/fracture/polygon_mesh.h"

namespace scree {

/// Of a closed mesh of triangles, the part in each cell (voronoi_cells.h), each straight from both: the
/// triangles near the cell cut to it, and each face of the cell cut to the solid, along the line where the
/// surface crosses the face. A cell that no triangle comes near is a part as it is, or none.
///
/// Parts are closed but for rounding: a face's corners are computed apart from its neighbours'.
std::vector<PolygonMesh> conform_cells(const PolygonMesh& mesh, const std::vector<PolygonMesh>& cells);

}  // namespace scree
