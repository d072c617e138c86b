// The cutter `slice`: the paper's recursive mesh slicing (1.2.2, 2.3). Voxels; deterministic.
#pragma once

#include <vector>

#include "shared/fracture/polygon_mesh.h"

namespace scree {

/// Of a closed mesh, the closed part in each cell (voronoi_cells.h): cut by the planes of the cell's faces,
/// one after the other, each hole capped. The paper begins every cell with the whole mesh; here halves of the
/// cells begin with what lies about them, halved again and again, so that the cost does not grow with mesh
/// times cells.
std::vector<PolygonMesh> slice_by_cells(const PolygonMesh& mesh, const std::vector<PolygonMesh>& cells);

}  // namespace scree
