// Which generated chunks are kept, and which chunks of a field that pages are in memory.
#include "shared/field/generated_cache.h"

#include <gtest/gtest.h>

#include "shared/field/chunk_residence.h"

namespace scree {
namespace {

GeneratedChunk solid(bool exact = true) {
  GeneratedChunk chunk = uniform_chunk(solid_brick());
  chunk.exact = exact;
  return chunk;
}

ChunkCoord nth(int i) {
  return {i, 0, 0};
}

/// Holds ten chunks, in two halves.
size_t room_for_ten() {
  return 10 * solid().bytes();
}

TEST(GeneratedCache, chunks_that_are_used_stay_and_the_others_go) {
  GeneratedCache cache(room_for_ten());
  for (int i = 0; i < 5; ++i) cache.add(nth(i), solid());
  EXPECT_EQ(cache.drops(), 0U);
  for (int i = 5; i < 9; ++i) cache.add(nth(i), solid());
  EXPECT_EQ(cache.chunks(), 9U) << "half of the room is for those that are used now";
  ASSERT_NE(cache.find(nth(0)), nullptr);
  for (int i = 9; i < 14; ++i) cache.add(nth(i), solid());
  EXPECT_NE(cache.find(nth(0)), nullptr);
  EXPECT_EQ(cache.find(nth(1)), nullptr);
  EXPECT_GE(cache.drops(), 2U);
}

TEST(GeneratedCache, never_keeps_more_than_it_may) {
  GeneratedCache cache(room_for_ten());
  for (int i = 0; i < 100; ++i) {
    cache.add(nth(i), solid());
    if (i % 3 == 0) cache.find(nth(i / 2));
    ASSERT_LE(cache.bytes(), cache.bytes_max());
    ASSERT_EQ(cache.bytes(), cache.chunks() * solid().bytes());
  }
}

TEST(GeneratedCache, has_exact_chunks_alone_until_better_ones_replace_the_others) {
  GeneratedCache cache(room_for_ten());
  GeneratedChunk& rough = cache.add(nth(1), solid(false));
  EXPECT_FALSE(cache.has_exact(nth(1)));
  EXPECT_FALSE(cache.has_exact(nth(2)));
  cache.replace(rough, solid());
  EXPECT_TRUE(cache.has_exact(nth(1)));
  EXPECT_EQ(cache.bytes(), solid().bytes());
}

TEST(GeneratedCache, drops_all_when_its_bound_becomes_too_small) {
  GeneratedCache cache(room_for_ten());
  for (int i = 0; i < 4; ++i) cache.add(nth(i), solid());
  cache.bound(5 * solid().bytes());
  EXPECT_EQ(cache.chunks(), 4U);
  cache.bound(2 * solid().bytes());
  EXPECT_EQ(cache.chunks(), 0U);
  EXPECT_EQ(cache.bytes(), 0U);
  EXPECT_EQ(cache.drops(), 1U);
}

TEST(ChunkResidence, counts_bricks_and_asks_for_what_is_out) {
  ChunkResidence residence;
  EXPECT_FALSE(residence.pages());
  std::vector<ChunkCoord> asked;
  residence.page_by([&](ChunkCoord chunk) { asked.push_back(chunk); });
  ASSERT_TRUE(residence.pages());
  residence.enter(nth(1), 3);
  residence.add_brick();
  EXPECT_EQ(residence.bricks(), 4U);
  EXPECT_TRUE(residence.chunks().contains(nth(1)));
  residence.leave(nth(1), 4);
  EXPECT_EQ(residence.bricks(), 0U);
  EXPECT_TRUE(residence.chunks().empty());
  residence.bring_in(nth(1));
  EXPECT_EQ(asked, std::vector{nth(1)});
}

}  // namespace
}  // namespace scree
