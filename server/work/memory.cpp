#include "server/work/memory.h"

#include <algorithm>
#include <set>

#include "server/work/limits.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

BrickCoord region_of(BrickCoord brick) {
  return {brick.x >> limits::region_bits, brick.y >> limits::region_bits, brick.z >> limits::region_bits};
}

/// Bytes beside the bricks that are in memory.
double other_bytes(const TerrainMemory& memory, uint32_t max_mb) {
  return limits::fixed_memory_bytes + memory.beyond_bytes +
         static_cast<double>(generated_bytes_within(max_mb)) * limits::generated_heap_factor +
         static_cast<double>(memory.chunks_out) * limits::chunk_out_bytes +
         static_cast<double>(memory.regions) * limits::region_memory_bytes;
}

}  // namespace

TerrainMemory memory_of(const Field& field) {
  CHECK(field.pages());
  std::unordered_set<BrickCoord, CoordHash> regions;
  for (const ChunkCoord chunk : field.chunks_in()) regions.insert(region_of(brick_in_chunk(chunk, 0)));
  return {field.bricks_in(), regions.size(), field.chunks_out(), 0.0};
}

double used_bytes(const TerrainMemory& memory, uint32_t max_mb) {
  return other_bytes(memory, max_mb) + static_cast<double>(memory.bricks) * limits::brick_memory_bytes;
}

double added_bytes(const VoxelBox& box, const Field& field) {
  CHECK(!box.empty());
  double bytes = 0.0;
  std::set<BrickCoord> regions;
  for_each_brick(box, [&](BrickCoord brick) {
    if (field.is_edited(brick)) return;
    bytes += limits::brick_memory_bytes;
    regions.insert(region_of(brick));
  });
  return bytes + static_cast<double>(regions.size()) * limits::region_memory_bytes;
}

size_t bricks_within(uint32_t max_mb, const TerrainMemory& memory) {
  const double room = max_mb * bytes_per_mb * (1.0 - limits::page_out_share) - other_bytes(memory, max_mb);
  return static_cast<size_t>(std::max(room, 0.0) / limits::brick_memory_bytes);
}

size_t generated_bytes_within(uint32_t max_mb) {
  const double share = max_mb * bytes_per_mb * limits::generated_memory_share;
  return static_cast<size_t>(
      std::clamp(share / limits::generated_heap_factor, 1.0, double{limits::generated_bytes_max}));
}

}  // namespace scree
