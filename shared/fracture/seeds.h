// Seeds scattered in a volume, whose Voronoi cells become pieces. Voxels; deterministic.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/field/piece.h"
#include "shared/field/window.h"
#include "shared/fracture/seed_pattern.h"

namespace scree {

/// Up to `count` seeds (voxels) inside the volume, no two nearer than a voxel; fewer where there is no room,
/// none where the volume has no solid voxel. The pattern is one of drawn_patterns.
std::vector<glm::vec3> scatter_seeds(const Window& volume, SeedPattern pattern, uint32_t count,
                                     uint32_t random_seed, glm::vec3 impact_voxels);

/// What a part of a volume has of a drawn pattern's seeds: how many, relative to the other parts, and the
/// pattern that most of them follow there. Far from the impact of a radial one that is the plain one.
struct SeedsDue {
  double share = 0.0;
  SeedPattern pattern = plain_pattern;
};
std::vector<SeedsDue> seeds_due(const std::vector<const Volume*>& parts, SeedPattern pattern,
                                glm::vec3 impact_voxels);

/// The points (voxels) that can be seeds, in their order. A point outside the volume (its voxel is not
/// solid), or nearer than a voxel to an earlier one, is dropped, so that every seed gets a cell. When none is
/// left, one random seed is added: the volume stays whole.
std::vector<glm::vec3> authored_seeds(const Window& volume, const std::vector<glm::vec3>& points_voxels,
                                      uint32_t random_seed);

}  // namespace scree
