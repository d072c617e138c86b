// Chunks that come to a client in parts, as by a slow link.
#include <algorithm>
#include <gtest/gtest.h>

#include "client/mirror/mirror.h"
#include "tests/support/flat_welcome.h"
#include "tests/support/tick_source.h"

namespace scree {
namespace {

/// A world, and a client that gets its chunks.
struct Followed {
  TickSource source{flat_terrain};
  Mirror mirror{flat_welcome()};

  ChunkMessage chunk(ChunkCoord coord) {
    ChunkMessage message;
    message.chunk = coord;
    message.hash = source.field().chunk_hash(coord);
    for (const BrickCoord brick : source.field().edited_bricks(coord))
      message.bricks.push_back({brick, source.field().brick(brick), source.field().materials(brick)});
    return message;
  }
};

/// The chunk in parts of a brick each.
std::vector<ChunkMessage> in_parts(const ChunkMessage& whole) {
  std::vector<ChunkMessage> parts;
  uint64_t edited = 0;
  for (const BrickPatch& brick : whole.bricks) {
    parts.push_back({.chunk = whole.chunk, .version = whole.version, .bricks = {brick}});
    edited |= uint64_t{1} << index_in_chunk(brick.coord);
  }
  for (ChunkMessage& part : parts) {
    part.edited = edited;
    part.more = &part != &parts.back();
    if (!part.more) part.hash = whole.hash;
  }
  return parts;
}

TEST(MirrorParts, a_chunk_in_parts_is_followed_with_the_last_one) {
  Followed followed;
  followed.source.step({followed.source.carve({1.0F, -0.5F, 1.0F}, 1.5F, 8)});
  ASSERT_GT(followed.source.field().edited_brick_count(), followed.source.field().edited_chunks().size());
  for (const ChunkCoord chunk : followed.source.field().edited_chunks()) {
    followed.mirror.field().set_brick(brick_in_chunk(chunk, 63), air_brick());  // no edit of the server's
    const std::vector<ChunkMessage> parts = in_parts(followed.chunk(chunk));
    for (const ChunkMessage& part : parts) {
      const auto applied = followed.mirror.apply(part);
      ASSERT_TRUE(applied);
      EXPECT_GE(applied->bricks.size(), part.bricks.size());
      EXPECT_EQ(followed.mirror.held_chunks().contains(chunk), !part.more);
      for (const BrickPatch& patch : part.bricks)
        EXPECT_EQ(followed.mirror.field().brick(patch.coord), patch.brick) << "it is shown at once";
    }
  }
  EXPECT_EQ(followed.mirror.field().hash(), followed.source.field().hash());
  EXPECT_EQ(followed.mirror.counters().chunks, followed.source.field().edited_chunks().size());
  EXPECT_FALSE(followed.mirror.next_repair_request());
}

TEST(MirrorParts, a_chunk_whose_other_bricks_were_wrong_is_asked_for_after_its_last_part) {
  Followed followed;
  followed.source.step({followed.source.carve({1.0F, -0.5F, 1.0F}, 1.5F, 8)});
  const auto bricks = [&](ChunkCoord chunk) { return followed.source.field().edited_bricks(chunk).size(); };
  const ChunkMessage whole =
      followed.chunk(std::ranges::max(followed.source.field().edited_chunks(), std::less<>{}, bricks));
  ASSERT_GT(whole.bricks.size(), 1U);
  const std::vector<ChunkMessage> parts = in_parts(whole);
  ASSERT_TRUE(followed.mirror.apply(parts.back())) << "the server takes the others for sent";
  const auto repair = followed.mirror.next_repair_request();
  ASSERT_TRUE(repair);
  EXPECT_EQ(repair->chunks, std::vector<ChunkCoord>{whole.chunk});
  for (const ChunkMessage& part : parts) ASSERT_TRUE(followed.mirror.apply(part));
  EXPECT_FALSE(followed.mirror.next_repair_request());
  EXPECT_EQ(followed.mirror.field().chunk_hash(whole.chunk), whole.hash);
  EXPECT_EQ(followed.mirror.counters().repairs_arrived, 1U);
}

}  // namespace
}  // namespace scree
