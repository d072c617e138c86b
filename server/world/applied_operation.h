// Describes an applied operation for the publisher: the chunks that it read and changed, and the pieces that
// it made. The live world and a replay share this function, so that a viewer cannot tell the difference.
#pragma once

#include "server/world/tick_delta.h"

namespace scree {

/// `reads` is read_box(operation, …) as it was before apply(); `applied` is what apply() returned.
/// Chunks come out ordered and without duplicates.
AppliedOperation describe(const Operation& operation, const VoxelBox& reads, const Applied& applied);

}  // namespace scree
