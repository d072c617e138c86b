#include "server/work/memory.h"

#include <gtest/gtest.h>

#include "server/work/limits.h"
#include "shared/base/limits.h"

namespace scree {
namespace {

TEST(terrain_memory, bricks_and_their_regions_count_once) {
  MapField field({TerrainKind::flat, 1, 0.25F});
  TerrainMemory memory;
  const double nothing = memory.used_bytes(0, 512);
  const std::vector<BrickCoord> bricks{{0, 0, 0}, {1, 0, 0}, {100, 0, 0}};
  for (const BrickCoord brick : bricks) field.set_brick(brick, solid_brick());
  memory.note(bricks);
  memory.note(bricks);
  field.set_brick(bricks[0], air_brick());
  EXPECT_EQ(field.edited_brick_count(), 3U);
  EXPECT_DOUBLE_EQ(memory.used_bytes(3, 512) - nothing,
                   3.0 * limits::brick_memory_bytes + 2.0 * limits::region_memory_bytes);
}

TEST(terrain_memory, an_edit_adds_what_was_not_edited_before) {
  MapField field({TerrainKind::flat, 1, 0.25F});
  TerrainMemory memory;
  const VoxelBox box{{0, 0, 0}, {16, 8, 8}};  // two bricks
  EXPECT_DOUBLE_EQ(memory.added_bytes(box, field),
                   2.0 * limits::brick_memory_bytes + limits::region_memory_bytes);
  const std::vector<BrickCoord> one{{0, 0, 0}};
  field.set_brick(one[0], solid_brick());
  memory.note(one);
  EXPECT_DOUBLE_EQ(memory.added_bytes(box, field), limits::brick_memory_bytes);
  EXPECT_GE(TerrainMemory::most_added_bytes(box), memory.added_bytes(box, field));
}

TEST(terrain_memory, generated_chunks_keep_to_their_share) {
  EXPECT_EQ(generated_chunks_within(1U << 20U), limits::generated_chunks_max);
  const double bytes = static_cast<double>(generated_chunks_within(512)) * limits::generated_chunk_bytes;
  EXPECT_LE(bytes, 512.0 * 1024.0 * 1024.0 * limits::generated_memory_share);
  MapField field({TerrainKind::flat, 1, 0.25F});
  field.bound_generated(4);
  for (int x = 0; x < 100; ++x) {
    field.generated_brick({4 * x, 0, 0});
    ASSERT_LE(field.generated_chunks(), 4U);
  }
}

}  // namespace
}  // namespace scree
