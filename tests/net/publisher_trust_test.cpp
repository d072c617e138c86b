// A client whose copy of a chunk is not known to be right: it gets no operation that reads the chunk, no
// check over it, and in the end the chunk itself.
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

TEST_F(PublisherTest, an_operation_on_what_one_left_out_has_changed_is_left_out_too) {
  tick({source.carve({0.0F, 0.0F, 0.0F}, 1.5F, 2)});
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick();  // the chunks arrive; pieces wait for the next tick with poses
  ASSERT_FALSE(publisher.view(session)->knows(1));
  tick({source.stamp(1), source.carve({0.5F, 0.0F, 0.0F}, 1.5F, 3)});
  const TrustingClient& follower = followers.at(session);
  EXPECT_EQ(follower.operations, 0U) << "the carve reads what the stamp changed, and the client has no stamp";
  EXPECT_GT(follower.patches, 0U);
  for (int i = 0; i < 12; ++i) tick();
  expect_whole_field_equal(session);
}

TEST_F(PublisherTest, no_operation_is_sent_on_a_chunk_that_is_still_to_be_repaired) {
  join(session, {4.0F, 2.0F, 4.0F}, 64.0F);
  tick({source.carve({4.0F, 0.0F, 4.0F}, 2.0F, 4)});
  const TrustingClient& follower = followers.at(session);
  ASSERT_EQ(follower.operations, 1U);
  spoil(session, chunk_of(VoxelCoord{16, -2, 16}));
  backlog_bytes = limits::outbox_soft_bytes + 1;  // nothing is streamed meanwhile
  tick({source.carve({4.5F, 0.0F, 4.0F}, 2.0F, 4)});
  EXPECT_EQ(follower.operations, 1U) << "the client's copy of what the carve reads is wrong";
  backlog_bytes = 0;
  for (int i = 0; i < 12; ++i) tick();
  expect_whole_field_equal(session);
}

TEST_F(PublisherTest, a_frame_with_a_chunk_that_it_leaves_half_told_carries_no_check) {
  tick({source.carve({0.0F, 0.0F, -150.0F}, 1.5F, 2)});
  join(session, {0.0F, 2.0F, 0.0F}, 200.0F);
  tick();
  ASSERT_FALSE(publisher.view(session)->knows(1));
  TrustingClient& follower = followers.at(session);
  follower.chunk_order.clear();
  // The carve is sent, the stamp is not, and what changes nearer by leaves no room for the bricks of both.
  deliver(*changed(source.step({source.carve({0.5F, 0.0F, -150.0F}, 1.5F, 2), source.stamp(1)}), flood()));
  ASSERT_EQ(follower.operations, 1U);
  ASSERT_EQ(std::ranges::count(follower.chunk_order, chunk_of(VoxelCoord{2, -2, -600})), 1)
      << "the chunk was not left half told";
  EXPECT_EQ(follower.mismatches, 0U) << "the client would ask for what is under way to it already";
  EXPECT_EQ(follower.unchecked, 1U);
  for (int i = 0; i < 30; ++i) tick();
  EXPECT_EQ(follower.field.hash(), source.field().hash());
}

TEST_F(PublisherTest, a_chunk_to_be_repaired_is_sent_though_the_client_moves_off_a_little) {
  constexpr float radius_m = 24.0F;
  const ChunkCoord chunk = chunk_of(VoxelCoord{16, -2, 16});
  join(session, {4.0F, 2.0F, 4.0F}, radius_m);
  tick({source.carve({4.0F, 0.0F, 4.0F}, 2.0F, 4)});
  publisher.set_interest(session, {36.0F, 2.0F, 4.0F}, radius_m);  // 28 m from the chunk: kept, not wanted
  for (int i = 0; i < 12; ++i) tick();
  ASSERT_TRUE(publisher.view(session)->held().contains(chunk));
  spoil(session, chunk);
  backlog_bytes = limits::outbox_soft_bytes + 1;
  publisher.set_interest(session, {36.0F, 2.0F, 4.0F}, radius_m);
  for (int i = 0; i < 12; ++i) tick();
  ASSERT_FALSE(publisher.view(session)->held().contains(chunk));
  backlog_bytes = 0;
  for (int i = 0; i < 12; ++i) tick();
  EXPECT_EQ(followers.at(session).field.chunk_hash(chunk), source.field().chunk_hash(chunk));
}

TEST_F(PublisherTest, chunks_are_streamed_nearest_first_within_a_budget_of_bytes) {
  Random random(5);
  std::vector<std::pair<BrickCoord, Brick>> noise;
  for (int x = 0; x < 8; ++x)
    for (int z = 0; z < 8; ++z)
      for (int brick = 0; brick < 8; ++brick) {
        noise.emplace_back(brick_in_chunk({x, 0, z}, brick), Brick{});
        for (Code& code : noise.back().second.codes) code = static_cast<Code>(random.below(200)) - 100;
      }
  change(noise);
  join(session, {0.0F, 2.0F, 0.0F}, 200.0F);
  const TrustingClient& follower = followers.at(session);
  constexpr size_t largest_bytes = 8 * 600;  // what does not compress, and where it lies
  size_t ticks = 0;
  for (; ticks == 0 || publisher.view(session)->wanted_chunks() != 0; ++ticks) {
    tick();
    ASSERT_LT(ticks, 100U) << "the streaming stands still";
    ASSERT_LE(follower.chunk_bytes, (ticks + 1) * limits::chunk_bytes_per_tick + largest_bytes);
  }
  EXPECT_GT(ticks, 8U);
  EXPECT_LE(ticks, follower.chunk_bytes / limits::chunk_bytes_per_tick + 1) << "the budget is spent";
  EXPECT_TRUE(std::ranges::is_sorted(follower.chunk_order, {}, [](ChunkCoord c) {
    return c.x * c.x + c.z * c.z;
  })) << "nearest first";
  expect_whole_field_equal(session);
}

}  // namespace
}  // namespace scree
