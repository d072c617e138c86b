// How a restore is applied. Private to operations.
#pragma once

#include "shared/base/result.h"
#include "shared/operation/operation.h"

namespace scree {

/// The voxels of the chunk in which its bricks lie; empty where it has none.
VoxelBox restored_box(const RestoreOperation& op);

/// Whether it can be applied: bricks of one chunk of the world, pieces that there are.
Result<void> validate_restore(const RestoreOperation& op, const PieceTable& pieces, float voxel_size_m);

/// Applies a valid restore. Bricks that are so already do not change.
Applied apply_restore(const RestoreOperation& op, Field& field, PieceTable& pieces);

}  // namespace scree
