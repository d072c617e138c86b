// The second half of a natural break (SeedPattern::natural): the blocks of a first, coarse cut are cut on.
//
// Fragments of blasted rock follow Rosin and Rammler's law (1933): by mass, a share 1 − exp(−(d/d*)^n) is
// smaller than d, and n lies between 0.8 and 2.2 (Cunningham 1983, "The Kuz-Ram model"). The cells of one
// Voronoi diagram cannot be so unlike, wherever its seeds lie: two that touch share what lies between their
// seeds. So blocks are cut first, few and dense about the blow. Each is cut on by itself into cells of one
// size, which the law says: the less mass lies nearer to the blow, the smaller. What is finer than the pieces
// becomes dust. Voxels; deterministic.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "shared/fracture/cutter.h"

namespace scree {

struct NaturalBreak {
  Cutter cutter = Cutter::field;
  uint32_t seeds = 1;  ///< pieces, at most
  uint32_t random_seed = 0;
  glm::vec3 impact_voxels{0.0F};
};

/// Seeds of the first cut of a break into so many pieces.
uint32_t seeds_of_blocks(uint32_t seeds);

/// Cuts the pieces of a first cut on, and turns the finest into dust. The blocks have their materials
/// (share_materials); so have the pieces then. Mass stays, in all and by material. Volumes that have no room
/// for so many pieces that follow the law are cut into fewer.
void cut_on(Cut& cut, const NaturalBreak& natural);

}  // namespace scree
