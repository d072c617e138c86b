// How a piece breaks: all of it, or what a shape cuts out of it (ShatterOperation). Private to this folder.
#pragma once

#include <cstdint>

#include "shared/fracture/cutter.h"
#include "shared/fracture/natural_cut.h"
#include "shared/fracture/seed_pattern.h"
#include "shared/operation/operation.h"

namespace scree {

/// How many seeds the pattern places for a carve or a shatter.
template <typename Break>
uint32_t first_seeds(const Break& op) {
  return is_cut_on(op.pattern) ? seeds_of_blocks(op.seeds) : op.seeds;
}

/// The second half of a carve or a shatter whose pattern has one.
template <typename Break>
void finish_cut(Cut& cut, const Break& op, glm::vec3 impact_voxels) {
  if (is_cut_on(op.pattern)) cut_on(cut, {op.cutter, op.seeds, op.random_seed, impact_voxels});
}

/// The pieces and the dust that a valid operation makes of its piece, with their materials; their masses add
/// up to exactly the piece's. Enters the seeds, and how many of the pieces are what a shape left.
Cut cut_of(const ShatterOperation& op, const Volume& piece, float voxel_size_m, Applied& applied);

}  // namespace scree
