#include "server/work/memory.h"

#include <algorithm>

#include "server/work/limits.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

BrickCoord region_of(BrickCoord brick) {
  return {brick.x >> limits::region_bits, brick.y >> limits::region_bits, brick.z >> limits::region_bits};
}

}  // namespace

void TerrainMemory::note(std::span<const BrickCoord> bricks) {
  for (const BrickCoord brick : bricks) regions_.insert(region_of(brick));
}

double TerrainMemory::used_bytes(size_t edited_bricks, uint32_t max_mb) const {
  return limits::fixed_memory_bytes +
         static_cast<double>(generated_chunks_within(max_mb)) * limits::generated_chunk_bytes +
         static_cast<double>(edited_bricks) * limits::brick_memory_bytes +
         static_cast<double>(regions_.size()) * limits::region_memory_bytes;
}

double TerrainMemory::most_added_bytes(const VoxelBox& box) {
  CHECK(!box.empty());
  const BrickCoord bricks = brick_of(box.hi - VoxelCoord{1, 1, 1}) - brick_of(box.lo) + BrickCoord{1, 1, 1};
  return static_cast<double>(bricks.x) * bricks.y * bricks.z *
         (limits::brick_memory_bytes + limits::region_memory_bytes);
}

double TerrainMemory::added_bytes(const VoxelBox& box, const Field& field) const {
  double bytes = 0.0;
  std::set<BrickCoord> regions;
  for_each_brick(box, [&](BrickCoord brick) {
    if (!field.is_edited(brick)) bytes += limits::brick_memory_bytes;
    if (!regions_.contains(region_of(brick))) regions.insert(region_of(brick));
  });
  return bytes + static_cast<double>(regions.size()) * limits::region_memory_bytes;
}

size_t generated_chunks_within(uint32_t max_mb) {
  const double share = static_cast<double>(max_mb) * 1024.0 * 1024.0 * limits::generated_memory_share;
  return static_cast<size_t>(std::clamp(share / limits::generated_chunk_bytes, 1.0,
                                        static_cast<double>(limits::generated_chunks_max)));
}

}  // namespace scree
