// What a publisher needs to know about an operation that was applied: the chunks it read and changed, the
// pieces it made. The live world and a replay both say it with this one function, so that a viewer cannot
// tell the difference.
#pragma once

#include "server/world/tick_delta.h"

namespace scree {

/// `reads` is read_box(operation, …) as it was before apply(); `applied` is what apply() returned.
/// Chunks come out ordered and without duplicates.
AppliedOperation describe(const Operation& operation, const VoxelBox& reads, const Applied& applied);

}  // namespace scree
