// Ground on request: complete, within the interest, in turn, and at a bounded cost in a tick.
#include <gtest/gtest.h>

#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

class GroundTest : public PublisherTest {
 protected:
  /// A block of chunks about the origin; those of y −1 and 0 hold the surface.
  static std::vector<ChunkCoord> block(int side) {
    std::vector<ChunkCoord> chunks;
    for (int x = 0; x < side; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = 0; z < side; ++z) chunks.push_back({x - side / 2, y, z - side / 2});
    return chunks;
  }
  static void expect_as_generated(const GroundMessage& ground) {
    const GeneratedChunk generated = generate_chunk(flat_terrain, ground.chunk);
    uint64_t hash = 0;
    size_t listed = 0;
    for (int i = 0; i < 64; ++i) {
      const BrickCoord coord = brick_in_chunk(ground.chunk, i);
      const Brick& wanted = *generated.bricks[static_cast<size_t>(i)];
      hash += brick_hash(coord, wanted);
      const auto found = std::ranges::find(ground.bricks, coord, &BrickPatch::coord);
      if (found != ground.bricks.end()) {
        ++listed;
        EXPECT_TRUE(found->brick == wanted);
      } else {
        EXPECT_TRUE((((ground.rock >> i) & 1U) != 0 ? solid_brick() : air_brick()) == wanted);
      }
    }
    EXPECT_EQ(listed, ground.bricks.size());
    EXPECT_EQ(ground.hash, hash);
  }
};

TEST_F(GroundTest, each_chunk_is_answered_once_in_order_with_all_its_bricks) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F, false);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 4)});  // what it did is not ground
  const std::vector<ChunkCoord> asked = block(3);
  ASSERT_TRUE(publisher.ask_ground(session, {asked}));
  for (int i = 0; i < 60; ++i) tick();
  const TrustingClient& follower = followers.at(session);
  ASSERT_EQ(follower.grounds.size(), asked.size());
  for (size_t i = 0; i < asked.size(); ++i) {
    EXPECT_EQ(follower.grounds[i].chunk, asked[i]);
    EXPECT_FALSE(follower.grounds[i].beyond);
    expect_as_generated(follower.grounds[i]);
  }
}

TEST_F(GroundTest, a_tick_generates_little_and_sends_within_a_budget) {
  join(session, {0.0F, 2.0F, 0.0F}, 200.0F, false);
  ASSERT_TRUE(publisher.ask_ground(session, {block(10)}));
  const TrustingClient& follower = followers.at(session);
  for (size_t before = 0; follower.grounds.size() < 300; before = follower.grounds.size()) {
    tick();
    ASSERT_GT(follower.grounds.size(), before);
    ASSERT_LE(follower.grounds.size() - before, static_cast<size_t>(limits::ground_work_min));
  }
  // All of it is kept now: only the bytes bound it.
  join(2, {0.0F, 2.0F, 0.0F}, 200.0F, false);
  ASSERT_TRUE(publisher.ask_ground(2, {block(10)}));
  size_t ticks = 0;
  for (; followers.at(2).grounds.size() < 300; ++ticks) tick();
  EXPECT_LT(ticks, 20U);
  EXPECT_LE(publisher.stats().ground_bytes / 2, (ticks + 1) * limits::ground_bytes_per_tick);
}

TEST_F(GroundTest, who_asks_for_much_does_not_keep_others_waiting) {
  join(session, {0.0F, 2.0F, 0.0F}, 200.0F, false);
  join(2, {0.0F, 2.0F, 0.0F}, 200.0F, false);
  ASSERT_TRUE(publisher.ask_ground(session, {block(18)}));
  tick();
  const std::vector<ChunkCoord> few{{12, -1, 12}, {12, 0, 12}, {13, 0, 12}, {13, -1, 12}};
  ASSERT_TRUE(publisher.ask_ground(2, {few}));
  for (size_t i = 0; i < 2 * few.size(); ++i) tick();  // every second one is its turn
  EXPECT_EQ(followers.at(2).grounds.size(), few.size());
  EXPECT_LT(followers.at(session).grounds.size(), 100U);
}

TEST_F(GroundTest, what_lies_beyond_the_interest_is_answered_without_bricks) {
  join(session, {4.0F, 2.0F, 4.0F}, 20.0F, false);
  // 8 m a chunk: these begin 20, 28 and 36 m from the eye; 25 m is 1.25 times the radius.
  ASSERT_TRUE(publisher.ask_ground(session, {{{3, 0, 0}, {4, 0, 0}, {5, 0, 0}}}));
  for (int i = 0; i < 4; ++i) tick();
  TrustingClient& follower = followers.at(session);
  ASSERT_EQ(follower.grounds.size(), 3U);
  EXPECT_FALSE(follower.grounds[0].beyond);
  EXPECT_TRUE(follower.grounds[1].beyond);
  EXPECT_TRUE(follower.grounds[2].beyond);
  publisher.set_interest(session, {24.0F, 2.0F, 4.0F}, 20.0F);
  ASSERT_TRUE(publisher.ask_ground(session, {{{5, 0, 0}}}));
  for (int i = 0; i < 4; ++i) tick();
  EXPECT_FALSE(follower.grounds[3].beyond) << "the interest that was told last counts";
}

TEST_F(GroundTest, a_slow_reader_waits_and_gets_its_ground_later) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F, false);
  ASSERT_TRUE(publisher.ask_ground(session, {{{0, 0, 0}}}));
  backlog_bytes = limits::outbox_soft_bytes + 1;
  for (int i = 0; i < 5; ++i) tick();
  EXPECT_TRUE(followers.at(session).grounds.empty());
  backlog_bytes = 0;
  tick();
  EXPECT_EQ(followers.at(session).grounds.size(), 1U);
}

TEST_F(GroundTest, what_waits_is_bounded_and_goes_with_its_session) {
  GroundStream stream(flat_terrain);
  const std::vector<ChunkCoord> most(limits::ground_chunks_max);
  EXPECT_TRUE(stream.ask(1, 1, most));
  EXPECT_FALSE(stream.ask(1, 1, {{{0, 0, 0}}}));
  EXPECT_EQ(stream.waiting(1), limits::ground_chunks_max);
  EXPECT_TRUE(stream.ask(2, 2, {{{0, 0, 0}}})) << "another one's bound is its own";
  stream.leave(1);
  EXPECT_EQ(stream.waiting(1), 0U);
}

}  // namespace
}  // namespace scree
