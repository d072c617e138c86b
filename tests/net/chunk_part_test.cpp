// Chunks by a slow link: in parts that it takes soon, with frames between them, and in the end the whole
// field.
#include "server/publish/chunk_part.h"

#include <bit>
#include <gtest/gtest.h>

#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

TEST(ChunkPart, bricks_come_in_turn_and_one_at_least) {
  const ChosenBricks one = choose_bricks(0b1011, 0, 1);
  EXPECT_EQ(one.bricks, 0b0001U);
  EXPECT_EQ(one.next, 1);
  const ChosenBricks two = choose_bricks(0b1011, one.next, 2 * limits::patch_brick_bytes);
  EXPECT_EQ(two.bricks, 0b1010U);
  EXPECT_EQ(two.next, 4);
  EXPECT_EQ(choose_bricks(0b1011, two.next, 2 * limits::patch_brick_bytes).bricks, 0b0011U) << "around";
  EXPECT_EQ(choose_bricks(~uint64_t{0}, 63, 1).next, 0);
  EXPECT_EQ(choose_bricks(~uint64_t{0}, 5, size_t{1} << 20U).bricks, ~uint64_t{0});
  EXPECT_EQ(choose_bricks(0, 5, 1000).bricks, 0U);
}

class SlowLinkTest : public PublisherTest {
 protected:
  static constexpr glm::vec3 eye_m{0.0F, 2.0F, 0.0F};
  static constexpr size_t slow_bytes = limits::outbox_soft_min_bytes;
  /// Carves, and most of their pieces become terrain again: bricks that do not compress well.
  void rubble() {
    for (int i = 0; i < 6; ++i)
      tick({source.carve({3.0F * static_cast<float>(i) - 8.0F, -1.0F, 1.0F}, 2.0F, 6)});
    while (source.pieces().size() > 4) tick({source.stamp(source.pieces().begin()->first)});
  }
  void follow_all() {
    const ClientView& view = *publisher.view(session);
    const auto waits = [&] {
      return view.wanted_chunks() != 0 || view.known_pieces() < source.pieces().size();
    };
    for (int ticks = 0; ticks == 0 || waits(); ++ticks) {
      tick();
      ASSERT_LT(ticks, 2000) << "the streaming stands still";
    }
  }
  TrustingClient& follower() { return followers.at(session); }
};

TEST_F(SlowLinkTest, chunks_come_in_parts_as_large_as_the_room) {
  rubble();
  soft_bytes = slow_bytes;
  for (const bool has_kernels : {true, false}) {
    followers.clear();
    join(session, eye_m, 64.0F, has_kernels);
    join(2, eye_m, 64.0F, has_kernels);
    follow_all();
    expect_whole_field_equal(session);
    EXPECT_EQ(followers.at(2).chunk_parts, 0U) << "others get chunks whole";
    EXPECT_GT(followers.at(2).largest_chunk_bytes, 2 * slow_bytes);
    EXPECT_GT(follower().chunk_parts, 2 * follower().chunks);
    EXPECT_LE(follower().largest_chunk_bytes, 2 * slow_bytes);
    EXPECT_LE(follower().chunk_bytes, 2 * followers.at(2).chunk_bytes) << "parts cost little more";
  }
}

TEST_F(SlowLinkTest, what_changes_between_the_parts_of_a_chunk_comes_again) {
  rubble();
  soft_bytes = slow_bytes;
  join(session, eye_m, 64.0F);
  for (int i = 0; i < 60; ++i) {
    std::vector<Operation> operations{source.carve({0.1F * static_cast<float>(i), -1.0F, 1.0F}, 1.0F, 2)};
    if (source.pieces().size() > 8) operations.emplace_back(source.stamp(source.pieces().begin()->first));
    tick(operations);
  }
  ASSERT_GT(follower().chunk_parts, 0U);
  follow_all();
  expect_whole_field_equal(session);
}

TEST_F(SlowLinkTest, of_a_chunk_that_it_has_only_the_bricks_that_changed_come) {
  rubble();
  join(session, eye_m, 64.0F);
  follow_all();
  soft_bytes = backlog_bytes = slow_bytes;  // no room for patches
  const ChunkCoord chunk = source.field().edited_chunks().front();
  change({{brick_in_chunk(chunk, 5), solid_brick()}, {brick_in_chunk(chunk, 6), air_brick()}});
  ASSERT_EQ(publisher.view(session)->wanted_chunks(), 1U);
  backlog_bytes = 0;
  follow_all();
  EXPECT_EQ(follower().chunk_parts, 1U);
  EXPECT_EQ(follower().bricks_of_parts, 2U);
  expect_whole_field_equal(session);
}

TEST_F(SlowLinkTest, a_chunk_of_which_a_part_has_come_is_dropped_with_it) {
  rubble();
  soft_bytes = slow_bytes;
  join(session, eye_m, 24.0F);
  while (follower().chunk_parts == 0) tick();
  ASSERT_GT(publisher.view(session)->wanted_chunks(), 0U);
  publisher.set_interest(session, {200.0F, 2.0F, 0.0F}, 24.0F);
  for (int i = 0; i < 12; ++i) tick();
  EXPECT_EQ(follower().field.hash(), 0U);
  publisher.set_interest(session, eye_m, 64.0F);
  for (int i = 0; i < 12; ++i) tick();
  follow_all();
  expect_whole_field_equal(session);
}

TEST_F(SlowLinkTest, a_wrong_chunk_is_mended_whole_by_parts) {
  rubble();
  join(session, eye_m, 64.0F);
  follow_all();
  soft_bytes = slow_bytes;
  const ChunkCoord chunk = source.field().edited_chunks().front();
  spoil(session, chunk);
  follow_all();
  EXPECT_EQ(follower().bricks_of_parts, source.field().edited_bricks(chunk).size());
  expect_whole_field_equal(session);
}

TEST_F(SlowLinkTest, ground_comes_one_chunk_at_a_time_and_all_of_it) {
  soft_bytes = slow_bytes;
  join(session, eye_m, 64.0F, false);
  std::vector<ChunkCoord> asked;
  for (int i = 0; i < 24; ++i) asked.push_back({i % 4 - 2, -(i / 4 % 2), i / 8});
  ASSERT_TRUE(publisher.ask_ground(session, {asked}));
  size_t most = 0;
  for (size_t before = 0; follower().grounds.size() < asked.size(); before = follower().grounds.size()) {
    tick();
    size_t bytes_of_tick = 0;
    for (size_t i = before; i + 1 < follower().grounds.size(); ++i)
      bytes_of_tick += encode(ServerMessage(follower().grounds[i])).size();
    most = std::max(most, bytes_of_tick);
    ASSERT_LT(source.tick(), 500U) << "the ground stands still";
  }
  EXPECT_LE(most, slow_bytes / 2) << "but for the last one of a tick";
}

}  // namespace
}  // namespace scree
