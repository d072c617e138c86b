// A piece breaks: its volume cut along Voronoi cells, in its own voxel frame. The terrain has no part in it.
#pragma once

#include "shared/fracture/voronoi.h"

namespace scree {

/// What the children weigh together, and the dust, is exactly what the piece weighed: its mass is shared out
/// in proportion to the masses of their cells, whose sum differs a little from it (the piece's mass is
/// what the terrain lost to it). Children keep the voxel frame of the piece; their centres are their own.
Cut shatter(Cutter cutter, const Volume& piece, const std::vector<glm::vec3>& seeds_voxels);

}  // namespace scree
