// The cutter `conform`: Voronoi cells bounded by the shape itself, without recursive slicing (paper, 1.2.2).
// Voxels; deterministic.
#pragma once

#include <vector>

#include "shared/fracture/polygon_cut.h"
#include "shared/fracture/polygon_mesh.h"

namespace scree {

/// The part of a closed mesh of triangles in each cell (voronoi_cells.h), computed directly from the two. The
/// triangles near the cell are cut to the cell. Each face of the cell is cut to the solid, along the line
/// where the surface crosses the face. A cell that no triangle comes near is a part as a whole, or empty.
///
/// Parts are closed except for rounding: the corners of each face are computed separately.
std::vector<PolygonMesh> conform_cells(const PolygonMesh& mesh, const std::vector<PolygonMesh>& cells);

inline constexpr PolygonCutting conform_cutting{.parts = conform_cells, .closed = false};

}  // namespace scree
