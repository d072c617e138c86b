// Breaks a piece: its volume is cut along Voronoi cells, in its own voxel frame. The terrain takes no part.
#pragma once

#include "shared/fracture/cutter.h"

namespace scree {

/// The masses of the children and the dust add up to exactly the piece's mass. It is shared out in proportion
/// to the masses of the children's cells, whose sum differs a little from it: a piece's mass is the mass that
/// the terrain lost to it. Children keep the voxel frame of the piece; their centres are their own.
Cut shatter(Cutter cutter, const Volume& piece, const std::vector<glm::vec3>& seeds_voxels);

}  // namespace scree
