// Seeds of the pattern `even`: far from each other, so that their cells are of like size.
//
// Lloyd's method (1982) over the volume itself: from uniform seeds, each moves to the centre of mass of its
// cell, and again. The volume is represented by samples of its voxels; voro++ finds the cell that each lies
// in. Only the server does this: the operation carries the points. Deterministic.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/field/window.h"

namespace scree {

/// Up to `count` seeds (voxels) in the volume's solid voxels; fewer where there is no room, none where the
/// volume has no solid voxel. `count` is within 1 … limits::seeds_max.
std::vector<glm::vec3> even_seeds(const Window& volume, uint32_t count, uint32_t random_seed);

}  // namespace scree
