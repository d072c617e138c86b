// Which pieces that merge at the same time do so in one pass.
#pragma once

#include <span>
#include <vector>

#include "shared/operation/operation.h"

namespace scree {

/// The pieces in groups, each led by the first in order. A piece joins the first group whose window its own
/// overlaps so much that one window around all holds no more voxels than one for each would; as far as they
/// can_merge_together.
std::vector<std::vector<StampedPiece>> stamp_groups(std::span<const StampedPiece> places,
                                                    const PieceTable& pieces, float voxel_size_m);

}  // namespace scree
