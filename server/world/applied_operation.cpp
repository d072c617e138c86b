#include "server/world/applied_operation.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {

AppliedOperation describe(const Operation& operation, const VoxelBox& reads, const Applied& applied) {
  AppliedOperation described;
  described.operation = operation;
  for_each_chunk(reads, [&](ChunkCoord chunk) { described.reads.push_back(chunk); });
  described.writes.reserve(applied.changed.size());
  for (const BrickCoord brick : applied.changed) described.writes.push_back(chunk_of(brick));
  std::ranges::sort(described.writes);
  described.writes.erase(std::unique(described.writes.begin(), described.writes.end()),
                         described.writes.end());
  described.created.reserve(applied.created.size());
  for (const CreatedPiece& piece : applied.created) described.created.push_back(piece.id);
  described.stored = applied.stored;
  CHECK_DEBUG(std::ranges::is_sorted(described.reads));
  CHECK_DEBUG(std::ranges::includes(described.reads, described.writes));
  return described;
}

}  // namespace scree
