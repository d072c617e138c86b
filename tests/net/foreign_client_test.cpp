// Clients without kernels: they get no operation, and have the server's bricks and pieces all the same.
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

class ForeignClientTest : public PublisherTest {
 protected:
  static constexpr bool no_kernels = false;

  /// Follows the server: what it holds is the server's, and its pieces are those that the view knows.
  void expect_in_step() {
    const TrustingClient& follower = followers.at(session);
    const ClientView& view = *publisher.view(session);
    const bool gets_frames = !follower.ticks.empty() && follower.ticks.back() == source.tick();
    if (gets_frames) expect_held_equal(session);
    EXPECT_EQ(follower.operations, 0U);
    EXPECT_EQ(follower.mismatches, 0U);
    EXPECT_EQ(follower.unchecked, 0U) << "whatever a frame changes can be checked";
    EXPECT_EQ(follower.pieces.size(), view.known_pieces());
    for (const auto& [id, volume] : follower.pieces) EXPECT_TRUE(view.knows(id));
  }
  /// Nothing that lies within the radius of the eye is missing or different.
  void expect_complete(glm::vec3 eye_m, float radius_m) {
    const TrustingClient& follower = followers.at(session);
    for (const ChunkCoord chunk : source.field().edited_chunks())
      if (distance_m(eye_m, chunk) <= radius_m) {
        EXPECT_TRUE(publisher.view(session)->held().contains(chunk));
        EXPECT_EQ(follower.field.chunk_hash(chunk), source.field().chunk_hash(chunk));
      }
    for (const auto& [id, piece] : publisher.state().pieces()) {
      if (glm::distance(dequantise(piece.pose).position_m, eye_m) > radius_m) continue;
      ASSERT_TRUE(follower.pieces.contains(id));
      EXPECT_EQ(follower.pieces.at(id)->window.codes, piece.volume->window.codes);
      EXPECT_EQ(follower.poses.at(id), piece.pose);
    }
  }
  static float distance_m(glm::vec3 eye_m, ChunkCoord chunk) {
    constexpr float side_m = chunk_size * voxel_m;
    const glm::vec3 lo = glm::vec3(chunk.x, chunk.y, chunk.z) * side_m;
    return glm::distance(glm::clamp(eye_m, lo, lo + side_m), eye_m);
  }
  /// A few operations of all kinds on what there is.
  std::vector<Operation> any_operations(Random& random) {
    const auto place = [&](float y_m) {
      return glm::vec3(random.below(40), y_m, random.below(40)) - glm::vec3(20.0F, 0.0F, 20.0F);
    };
    std::vector<Operation> operations;
    if (random.below(3) == 0) operations.push_back(source.carve(place(0.0F), 1.5F, 2 + random.below(6)));
    if (random.below(6) == 0) operations.push_back(FillOperation{sphere(place(1.0F), 1.0F)});
    if (random.below(6) == 0) operations.push_back(PaintOperation{sphere(place(0.0F), 2.0F), material::ice});
    for (const auto& [id, volume] : source.pieces()) {
      if (random.below(8) == 0)
        operations.push_back(source.stamp(id));
      else if (random.below(20) == 0)
        operations.push_back(DiscardOperation{id});
      else if (random.below(3) == 0)
        source.move(id, {0.0F, 0.25F, 0.0F});
    }
    return operations;
  }
};

TEST_F(ForeignClientTest, what_operations_did_arrives_as_bricks_and_whole_pieces) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F, no_kernels);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  const TrustingClient& follower = followers.at(session);
  EXPECT_EQ(follower.field.hash(), source.field().hash()) << "the first edits of a chunk are all its edits";
  for (int i = 0; i < 6; ++i) tick();
  EXPECT_EQ(follower.pieces.size(), source.pieces().size());
  tick({source.stamp(1), source.stamp(2)});
  EXPECT_FALSE(follower.pieces.contains(1)) << "a piece ends with the tick in which its bricks change";
  expect_whole_field_equal(session);
  expect_in_step();
  EXPECT_EQ(follower.chunks, 0U);
}

TEST_F(ForeignClientTest, random_sessions_of_a_client_that_moves_and_reads_slowly_end_in_step) {
  for (uint32_t random_seed = 1; random_seed <= 6; ++random_seed) {
    SCOPED_TRACE(random_seed);
    Random random(random_seed);
    glm::vec3 eye_m{0.0F, 2.0F, 0.0F};
    constexpr float radius_m = 20.0F;
    followers.erase(session);
    join(session, eye_m, radius_m, no_kernels);
    for (int i = 0; i < 120; ++i) {
      if (random.below(10) == 0) {
        eye_m = {static_cast<float>(random.below(60)) - 30.0F, 2.0F, 0.0F};
        publisher.set_interest(session, eye_m, radius_m);
      }
      const uint32_t reads = random.below(24);
      backlog_bytes =
          reads == 0 ? limits::outbox_resync_bytes + 1 : (reads < 5 ? limits::outbox_soft_bytes + 1 : 0);
      tick(any_operations(random));
      ASSERT_NO_FATAL_FAILURE(expect_in_step());
    }
    backlog_bytes = 0;
    for (int i = 0; i < 100; ++i) tick();
    expect_in_step();
    expect_complete(eye_m, radius_m);
    EXPECT_GT(followers.at(session).patches, 0U);
    EXPECT_GT(followers.at(session).piece_messages, 0U);
  }
}

TEST_F(ForeignClientTest, pieces_that_merge_before_their_turn_are_never_spoken_of) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F, no_kernels);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 8.0F, 200)});
  const size_t made = source.pieces().size();
  std::vector<Operation> merges;
  for (const auto& [id, volume] : source.pieces()) merges.push_back(source.stamp(id));
  ASSERT_GT(made, 30U);
  tick();
  tick(merges);
  for (int i = 0; i < 60; ++i) tick();
  EXPECT_LT(followers.at(session).piece_messages, made);
  expect_whole_field_equal(session);
  expect_in_step();
}

TEST_F(ForeignClientTest, patches_keep_to_a_budget_and_the_rest_comes_as_whole_chunks) {
  join(session, {0.0F, 2.0F, 0.0F}, 200.0F, no_kernels);
  const TrustingClient& follower = followers.at(session);
  Random random(3);
  constexpr size_t ticks = 12;
  for (size_t i = 0; i < ticks; ++i) {
    std::vector<std::pair<BrickCoord, Brick>> all = flood();
    for (auto& [coord, brick] : all) brick.codes.fill(static_cast<Code>(random.below(100)));
    change(all);
    ASSERT_LE(follower.patches, limits::patch_bricks_max + (i + 1) * limits::patch_bricks_per_tick);
  }
  EXPECT_GT(follower.chunks, 0U);
  for (int i = 0; i < 60; ++i) tick();
  EXPECT_EQ(follower.field.hash(), source.field().hash());
  expect_in_step();
}

TEST_F(ForeignClientTest, a_slow_reader_gets_no_patches_but_the_newest_chunks_later) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F, no_kernels);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 4)});
  const TrustingClient& follower = followers.at(session);
  const size_t patches = follower.patches;
  backlog_bytes = limits::outbox_soft_bytes + 1;
  for (int i = 0; i < 5; ++i) tick({source.carve({0.5F * static_cast<float>(i), 0.0F, 0.0F}, 2.0F, 2)});
  const auto heartbeat_ticks = static_cast<Tick>(limits::heartbeat_s * 60.0);
  for (Tick i = 0; i < heartbeat_ticks; ++i) tick();
  EXPECT_EQ(follower.patches, patches);
  EXPECT_GE(follower.ticks.back() + heartbeat_ticks, source.tick()) << "frames still say that time goes on";
  backlog_bytes = 0;
  for (int i = 0; i < 30; ++i) tick();
  EXPECT_EQ(follower.resets, 0U);
  expect_whole_field_equal(session);
}

TEST_F(ForeignClientTest, a_spoiled_chunk_comes_again) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F, no_kernels);
  tick({source.carve({4.0F, 0.0F, 4.0F}, 2.0F, 4)});
  spoil(session, chunk_of(VoxelCoord{16, -2, 16}));
  for (int i = 0; i < 6; ++i) tick();
  EXPECT_EQ(followers.at(session).chunks, 1U);
  expect_whole_field_equal(session);
}

TEST_F(ForeignClientTest, kernels_or_not_both_have_the_same_field_and_one_costs_more) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F, no_kernels);
  join(2, {0.0F, 2.0F, 0.0F}, 64.0F);
  for (int i = 0; i < 8; ++i) tick({source.carve({static_cast<float>(3 * i), 0.0F, 0.0F}, 1.5F, 6)});
  for (int i = 0; i < 30; ++i) tick();
  expect_whole_field_equal(session);
  expect_whole_field_equal(2);
  EXPECT_GT(bytes.at(session), 4 * bytes.at(2));
}

}  // namespace
}  // namespace scree
