#include "server/work/memory.h"

#include <gtest/gtest.h>

#include "server/work/limits.h"
#include "shared/base/limits.h"
#include "tests/support/chunk_shelf.h"

namespace scree {
namespace {

TEST(terrain_memory, bricks_and_their_regions_count_while_they_are_in_memory) {
  MapField field({TerrainKind::flat, 1, 0.25F});
  ChunkShelf shelf;
  field.page_by(shelf.reader());
  const TerrainMemory none = memory_of(field);
  EXPECT_EQ(none, TerrainMemory());
  for (const BrickCoord brick : {BrickCoord{0, 0, 0}, {1, 0, 0}, {100, 0, 0}})
    field.set_brick(brick, solid_brick());
  field.set_brick({0, 0, 0}, air_brick());
  EXPECT_EQ(memory_of(field), (TerrainMemory{3, 2, 0}));
  EXPECT_DOUBLE_EQ(used_bytes(memory_of(field), 512) - used_bytes(none, 512),
                   3.0 * limits::brick_memory_bytes + 2.0 * limits::region_memory_bytes);
  shelf.page_out_all(FieldPaging(field));
  EXPECT_EQ(memory_of(field), (TerrainMemory{0, 0, 2}));
  EXPECT_DOUBLE_EQ(used_bytes(memory_of(field), 512) - used_bytes(none, 512), 2.0 * limits::chunk_out_bytes);
}

TEST(terrain_memory, an_edit_adds_what_was_not_edited_before) {
  MapField field({TerrainKind::flat, 1, 0.25F});
  const VoxelBox box{{0, 0, 0}, {16, 8, 8}};  // two bricks
  EXPECT_DOUBLE_EQ(added_bytes(box, field), 2.0 * limits::brick_memory_bytes + limits::region_memory_bytes);
  field.set_brick({0, 0, 0}, solid_brick());
  EXPECT_DOUBLE_EQ(added_bytes(box, field), limits::brick_memory_bytes + limits::region_memory_bytes);
  field.set_brick({1, 0, 0}, solid_brick());
  EXPECT_DOUBLE_EQ(added_bytes(box, field), 0.0);
}

TEST(terrain_memory, so_many_bricks_leave_a_share_of_the_memory_free) {
  const TerrainMemory memory{0, 100, 10000};
  TerrainMemory full = memory;
  full.bricks = bricks_within(512, memory);
  EXPECT_GT(full.bricks, 100000U);
  constexpr double all = 512.0 * 1024.0 * 1024.0;
  EXPECT_LE(used_bytes(full, 512), all * (1.0 - limits::page_out_share));
  EXPECT_GE(used_bytes(full, 512), all * (1.0 - limits::page_out_share) - limits::brick_memory_bytes);
  EXPECT_EQ(bricks_within(1, memory), 0U);
}

TEST(terrain_memory, generated_chunks_keep_to_their_share) {
  EXPECT_EQ(generated_bytes_within(1U << 20U), limits::generated_bytes_max);
  const double bytes = static_cast<double>(generated_bytes_within(256)) * limits::generated_heap_factor;
  EXPECT_LE(bytes, 256.0 * 1024.0 * 1024.0 * limits::generated_memory_share);
}

TEST(terrain_memory, what_the_model_does_not_know_of_leaves_less_for_bricks) {
  TerrainMemory memory{0, 100, 10000};
  const double used = used_bytes(memory, 512);
  const size_t bricks = bricks_within(512, memory);
  memory.beyond_bytes = 50.0 * bytes_per_mb;
  EXPECT_DOUBLE_EQ(used_bytes(memory, 512), used + memory.beyond_bytes);
  EXPECT_NEAR(static_cast<double>(bricks - bricks_within(512, memory)),
              memory.beyond_bytes / limits::brick_memory_bytes, 1.0);
}

}  // namespace
}  // namespace scree
