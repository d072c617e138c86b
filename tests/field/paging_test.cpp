// Chunks out of memory: what is left of them, and that a user of one does not notice.
#include <gtest/gtest.h>

#include "server/field/vdb_field.h"
#include "shared/base/random.h"
#include "tests/support/chunk_shelf.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/materials.h"

namespace scree {
namespace {

Brick scribbled(Random& random) {
  Brick brick;
  for (Code& code : brick.codes) code = static_cast<Code>(random.next() % 255 - 127);
  return brick;
}

class PagingTest : public ::testing::Test {
 protected:
  PagingTest() {
    field.page_by(shelf.reader());
    for (Field* each : {static_cast<Field*>(&field), static_cast<Field*>(&other)})
      for (int i = 0; i < 200; ++i) {
        Random random(static_cast<uint32_t>(i));
        const BrickCoord coord{static_cast<int>(random.next() % 24), static_cast<int>(random.next() % 8), 0};
        each->set_brick(coord, i % 5 == 0 ? solid_brick() : scribbled(random));
        if (i % 7 == 0) each->set_materials(coord, all_of(material::ice));
      }
  }

  ChunkShelf shelf;
  VdbField field{flat_terrain};
  MapField other{flat_terrain};  ///< the same, with everything in memory
};

TEST_F(PagingTest, a_chunk_that_is_out_leaves_its_hash_and_its_edits) {
  const size_t chunks = other.edited_chunks().size(), bricks = other.edited_brick_count();
  EXPECT_EQ(field.bricks_in(), bricks);
  EXPECT_EQ(field.chunks_in().size(), chunks);
  const uint64_t bytes = field.memory_bytes();
  shelf.page_out_all(FieldPaging(field));
  EXPECT_EQ(field.chunks_out(), chunks);
  EXPECT_EQ(field.bricks_in(), 0U);
  constexpr uint64_t regions_bytes = 2 * uint64_t{33} << 10U;
  EXPECT_LT(field.memory_bytes() + regions_bytes, bytes) << "regions of the tree go, too";
  EXPECT_EQ(field.hash(), other.hash());
  EXPECT_EQ(field.edited_brick_count(), bricks);
  EXPECT_EQ(field.edited_chunks(), other.edited_chunks());
  for (const ChunkCoord chunk : other.edited_chunks()) {
    EXPECT_EQ(field.chunk_hash(chunk), other.chunk_hash(chunk));
    EXPECT_EQ(field.edited_bricks(chunk), other.edited_bricks(chunk));
    MassUnits mass = 0;
    for (const BrickCoord brick : other.edited_bricks(chunk)) mass += brick_mass(other.brick(brick));
    ASSERT_TRUE(field.paged(chunk).has_value());
    EXPECT_EQ(field.paged(chunk)->mass, mass);
  }
  EXPECT_EQ(shelf.reads, 0U);
}

TEST_F(PagingTest, whoever_reads_or_writes_brings_it_in_once) {
  shelf.page_out_all(FieldPaging(field));
  for (const ChunkCoord chunk : other.edited_chunks())
    for (const BrickCoord brick : other.edited_bricks(chunk)) {
      ASSERT_EQ(field.materials(brick), other.materials(brick));
      ASSERT_EQ(field.brick(brick), other.brick(brick));
    }
  EXPECT_EQ(shelf.reads, other.edited_chunks().size());
  EXPECT_EQ(field.page_waits(), shelf.reads);
  EXPECT_EQ(field.chunks_out(), 0U);
  Random random(5);
  for (int i = 0; i < 60; ++i) {
    shelf.page_out_all(FieldPaging(field));
    const BrickCoord coord{i % 30, i % 9, 0};
    const Brick brick = scribbled(random);
    const bool paints = i % 3 == 0;
    for (Field* each : {static_cast<Field*>(&field), static_cast<Field*>(&other)}) {
      if (paints)
        each->set_materials(coord, i % 2 == 0 ? all_of(material::soil) : BrickMaterials());
      else
        each->set_brick(coord, brick);
    }
    ASSERT_EQ(field.hash(), other.hash());
    ASSERT_EQ(field.edited_brick_count(), other.edited_brick_count());
  }
}

TEST_F(PagingTest, what_is_not_the_chunk_that_left_is_refused) {
  const ChunkCoord chunk = other.edited_chunks().front();
  shelf.copy(field, chunk);
  field.page_out(chunk);
  std::vector<BrickPatch>& stored = shelf.chunks.at(chunk);
  const std::vector<BrickPatch> right = stored;
  stored.front().brick.codes[5] ^= 1;
  EXPECT_FALSE(field.page_in(chunk, stored));
  EXPECT_THROW(static_cast<void>(field.brick(stored.front().coord)), ChunkUnreadable);
  stored = right;
  stored.pop_back();
  EXPECT_FALSE(field.page_in(chunk, stored));
  stored = right;
  stored.push_back(right.front());
  EXPECT_FALSE(field.page_in(chunk, stored));
  shelf.chunks.clear();
  EXPECT_THROW(field.set_brick(right.front().coord, air_brick()), ChunkUnreadable);
  EXPECT_TRUE(field.is_out(chunk));
  EXPECT_EQ(field.hash(), other.hash());
  EXPECT_TRUE(field.page_in(chunk, right));
  EXPECT_EQ(field.brick(right.front().coord), right.front().brick);
}

TEST_F(PagingTest, chunks_that_nobody_asked_for_are_idle_the_longest_first) {
  for (int turn = 0; turn < 10; ++turn) field.begin_turn();
  const std::vector<ChunkCoord> all = other.edited_chunks();
  ASSERT_GT(all.size(), 3U);
  field.brick(other.edited_bricks(all[0]).front());
  for (int turn = 0; turn < 3; ++turn) field.begin_turn();
  field.touch(all[1]);
  const std::vector<ChunkCoord> idle = field.idle_chunks(3);
  for (const ChunkCoord chunk : field.edited_chunks())
    EXPECT_EQ(field.is_idle(chunk, 3), std::ranges::find(idle, chunk) != idle.end());
  ASSERT_EQ(idle.size(), all.size() - 1);
  EXPECT_EQ(idle.back(), all[0]);
  EXPECT_EQ(std::ranges::count(idle, all[1]), 0);
}

}  // namespace
}  // namespace scree
