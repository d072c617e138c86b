// The points of relaxed seed patterns, which the server computes (SeedSource::relaxed).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/field/window.h"
#include "shared/fracture/seed_pattern.h"

namespace scree {

/// Up to `count` seeds (voxels) in the volume's solid voxels; fewer where there is no room, none where the
/// volume has no solid voxel. The pattern is relaxed; `count` is within 1 … limits::seeds_max.
std::vector<glm::vec3> relaxed_seeds(SeedPattern pattern, const Window& volume, uint32_t count,
                                     uint32_t random_seed);

}  // namespace scree
