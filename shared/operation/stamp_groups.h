// Groups pieces that merge at the same time, so that each group merges in one pass.
#pragma once

#include <span>
#include <vector>

#include "shared/operation/operation.h"

namespace scree {

/// Divides the pieces into groups, each in the given order. A piece joins the first group whose window
/// overlaps its own so much that one window around all has no more voxels than the separate ones, if they
/// can_merge_together().
std::vector<std::vector<StampedPiece>> stamp_groups(std::span<const StampedPiece> places,
                                                    const PieceTable& pieces, float voxel_size_m);

}  // namespace scree
