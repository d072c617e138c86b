// The publisher's selection, without sockets: what each client gets suffices to have the server's field.
#include "server/publish/publisher.h"

#include <gtest/gtest.h>

#include "server/publish/limits.h"
#include "server/world/world.h"
#include "shared/field/chunk_distance.h"
#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

TEST_F(PublisherTest, client_from_the_start_gets_operations_and_no_bricks) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  tick({source.carve({1.0F, 0.0F, 1.0F}, 1.5F, 4)});
  tick({source.stamp(1), source.stamp(2)});
  const TrustingClient& follower = followers.at(session);
  EXPECT_EQ(follower.operations, 4U);
  EXPECT_EQ(follower.patches + follower.chunks + follower.piece_messages, 0U);
  expect_whole_field_equal(session);
}

TEST_F(PublisherTest, late_joiner_gets_chunks_and_pieces_and_then_follows_by_operations) {
  for (int i = 0; i < 6; ++i) tick({source.carve({static_cast<float>(4 * i), 0.0F, 0.0F}, 1.5F, 6)});
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  for (int i = 0; i < 60; ++i) tick();
  TrustingClient& follower = followers.at(session);
  EXPECT_GT(follower.chunks, 0U);
  EXPECT_GT(follower.piece_messages, 0U);
  expect_whole_field_equal(session);
  const size_t chunks = follower.chunks;
  tick({source.stamp(1), source.carve({2.0F, 0.0F, 0.0F}, 1.5F, 4)});
  EXPECT_EQ(follower.operations, 2U);
  EXPECT_EQ(follower.chunks, chunks);
  EXPECT_EQ(follower.patches, 0U);
  expect_whole_field_equal(session);
}

TEST_F(PublisherTest, live_carves_while_a_joiner_is_still_streaming_leave_no_gap) {
  for (int i = 0; i < 40; ++i)
    tick({source.carve({static_cast<float>(3 * (i % 8)), 0.0F, static_cast<float>(3 * (i / 8))}, 2.0F, 3)});
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  for (int i = 0; i < 20; ++i)
    tick({source.carve({static_cast<float>(i), -1.0F, 5.0F}, 1.5F, 3),
          source.stamp(1 + static_cast<PieceId>(i))});
  for (int i = 0; i < 200; ++i) tick();
  EXPECT_GT(followers.at(session).patches + followers.at(session).chunks, 0U);
  expect_whole_field_equal(session);
}

TEST_F(PublisherTest, operation_whose_piece_is_unknown_arrives_as_bricks) {
  tick({source.carve({0.0F, 0.0F, 0.0F}, 1.5F, 2)});
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick();  // the chunks arrive; pieces wait for the next tick with poses
  ASSERT_FALSE(publisher.view(session)->knows(1));
  tick({source.stamp(1)});
  const TrustingClient& follower = followers.at(session);
  EXPECT_EQ(follower.operations, 0U);
  EXPECT_GT(follower.patches, 0U);
  for (int i = 0; i < 6; ++i) tick();
  expect_whole_field_equal(session);
}

TEST_F(PublisherTest, a_known_piece_shatters_by_operation_and_an_unknown_ones_children_arrive_whole) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 2)});
  join(2, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick();
  ASSERT_TRUE(publisher.view(session)->knows(1));
  ASSERT_FALSE(publisher.view(2)->knows(1));
  tick({ShatterOperation{1, SeedPattern::radial, 5, 3, source.pieces().at(1)->centre_voxels, 100}});
  EXPECT_EQ(followers.at(session).operations, 2U);
  EXPECT_EQ(followers.at(2).operations, 0U);
  for (int i = 0; i < 6; ++i) tick();
  EXPECT_EQ(followers.at(session).piece_messages, 0U);
  expect_whole_field_equal(session);
  expect_whole_field_equal(2);
}

TEST_F(PublisherTest, far_edits_cost_a_client_nothing) {
  join(session, {0.0F, 2.0F, 0.0F}, 16.0F);
  tick();
  const size_t empty_frame = last.at(session)->size();
  tick({source.carve({100.0F, 0.0F, 0.0F}, 2.0F, 16)});
  EXPECT_EQ(last.at(session)->size(), empty_frame);
  EXPECT_LE(empty_frame, 16U);
  EXPECT_EQ(publisher.view(session)->held().size(), 0U);
}

TEST_F(PublisherTest, pieces_are_streamed_within_a_budget_of_bytes) {
  tick({source.carve({0.0F, 0.0F, 0.0F}, 8.0F, 40)});
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  const TrustingClient& follower = followers.at(session);
  constexpr size_t largest_bytes = 8192;
  size_t ticks = 0;
  for (; follower.pieces.size() < source.pieces().size(); ++ticks) {
    tick();
    ASSERT_LT(ticks, 200U) << "the streaming stands still";
    // They come with the poses, every few ticks, and may then spend what the ticks between had.
    const size_t until_now = ticks + 1 + PublisherConfig{}.ticks_per_transform;
    ASSERT_LE(follower.piece_bytes, until_now * limits::piece_bytes_per_tick + largest_bytes);
  }
  EXPECT_GT(follower.piece_bytes, 6 * limits::piece_bytes_per_tick) << "too few to tell";
}

TEST_F(PublisherTest, moving_away_drops_and_coming_back_restores) {
  join(session, {0.0F, 2.0F, 0.0F}, 24.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  publisher.set_interest(session, {200.0F, 2.0F, 0.0F}, 24.0F);
  for (int i = 0; i < 12; ++i) tick();
  EXPECT_EQ(followers.at(session).field.hash(), 0U);
  EXPECT_TRUE(followers.at(session).pieces.empty());
  tick({source.stamp(1)});
  publisher.set_interest(session, {0.0F, 2.0F, 0.0F}, 24.0F);
  for (int i = 0; i < 60; ++i) tick();
  expect_whole_field_equal(session);
}

TEST_F(PublisherTest, a_status_counts_the_chunks_that_a_client_still_waits_for) {
  change(flood());
  join(session, {0.0F, 2.0F, 0.0F}, 200.0F);
  TrustingClient& follower = followers.at(session);
  const auto next_status = [&]() -> const StatusMessage& {
    for (const size_t had = follower.statuses.size(); follower.statuses.size() == had;) tick();
    return follower.statuses.back();
  };
  backlog_bytes = limits::outbox_soft_bytes + 1;  // nothing is streamed meanwhile
  EXPECT_EQ(next_status().chunks_waiting, 8U * 15U);
  backlog_bytes = 0;
  while (next_status().chunks_waiting > 0) ASSERT_LT(follower.statuses.size(), 100U) << "it stands still";
  EXPECT_EQ(follower.field.hash(), source.field().hash());
  publisher.set_interest(session, {500.0F, 2.0F, 0.0F}, 16.0F);
  EXPECT_EQ(publisher.view(session)->chunks_waiting(), 1U) << "it is not known yet what is there";
  EXPECT_EQ(next_status().chunks_waiting, 0U);
}

TEST_F(PublisherTest, what_leaves_interest_by_a_little_is_kept) {
  join(session, {4.0F, 2.0F, 4.0F}, 24.0F);
  tick({source.carve({4.0F, 0.0F, 4.0F}, 2.0F, 4)});
  for (const float x_m : {36.0F, 4.0F, 36.0F, 4.0F}) {  // 28 m from the chunk, and back
    publisher.set_interest(session, {x_m, 2.0F, 4.0F}, 24.0F);
    for (int i = 0; i < 12; ++i) tick();
  }
  const TrustingClient& follower = followers.at(session);
  EXPECT_EQ(follower.drops + follower.chunks, 0U)
      << "nothing is sent again and again to who walks to and fro";
  publisher.set_interest(session, {44.0F, 2.0F, 4.0F}, 24.0F);
  for (int i = 0; i < 12; ++i) tick();
  EXPECT_GT(follower.drops, 0U) << "36 m is too far";
}

TEST_F(PublisherTest, small_radius_holds_exactly_what_is_near) {
  join(session, {0.0F, 2.0F, 0.0F}, 10.0F);
  for (PieceId i = 0; i < 20; ++i) {
    tick({source.carve({2.0F * static_cast<float>(i), 0.0F, 0.0F}, 2.0F, 3)});
    tick({source.stamp(1 + 3 * i)});
  }
  for (int i = 0; i < 30; ++i) tick();
  EXPECT_GT(publisher.view(session)->held().size(), 0U);
  EXPECT_LT(publisher.view(session)->held().size(), source.field().edited_chunks().size());
  expect_held_equal(session);
  EXPECT_EQ(followers.at(session).mismatches, 0U);
}

TEST_F(PublisherTest, of_many_chunks_a_joiner_gets_exactly_those_that_are_near) {
  for (PieceId i = 0; i < 100; ++i) {
    const glm::vec3 place_m(16.0F * static_cast<float>(i % 10), 0.0F, 16.0F * static_cast<float>(i / 10));
    tick({source.carve(place_m, 2.0F, 3)});
    tick({source.stamp(1 + 3 * i)});
  }
  constexpr glm::vec3 eye_m(70.0F, 2.0F, 70.0F);
  join(session, eye_m, 10.0F);
  for (int i = 0; i < 30; ++i) tick();
  const auto& held = publisher.view(session)->held();
  size_t edited = 0, near = 0;
  for (const ChunkCoord chunk : source.field().edited_chunks()) {
    ++edited;
    const bool is_near = distance_to_chunk_m(eye_m, chunk, flat_terrain.voxel_size_m) <= 10.0F;
    near += is_near ? 1 : 0;
    EXPECT_EQ(held.contains(chunk), is_near);
  }
  EXPECT_EQ(held.size(), near);
  EXPECT_GT(near, 0U);
  EXPECT_GT(edited, 300U) << "more than there are places near";
}

TEST_F(PublisherTest, equal_clients_share_the_same_bytes) {
  join(1, {0.0F, 2.0F, 0.0F}, 64.0F);
  join(2, {1.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  EXPECT_EQ(last.at(1).get(), last.at(2).get());
}

TEST_F(PublisherTest, only_moved_pieces_have_transforms) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  for (int i = 0; i < 12; ++i) tick();  // until their motions rest
  TrustingClient& follower = followers.at(session);
  follower.poses.clear();
  source.move(3, {0.0F, 1.0F, 0.0F});
  for (int i = 0; i < 6; ++i) tick();
  ASSERT_EQ(follower.poses.size(), 1U);
  EXPECT_TRUE(follower.poses.contains(3));
}

TEST_F(PublisherTest, repair_resends_exactly_the_chunks_that_differ) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 4)});
  TrustingClient& follower = followers.at(session);
  RepairMessage request;
  request.tick = source.tick();
  request.chunks = source.field().edited_chunks();
  ASSERT_GE(request.chunks.size(), 2U);
  for (const ChunkCoord chunk : request.chunks) request.hashes.push_back(source.field().chunk_hash(chunk));
  const BrickCoord broken = follower.field.edited_bricks(request.chunks[0]).front();
  follower.field.set_brick(broken, solid_brick());
  request.hashes[0] = follower.field.chunk_hash(request.chunks[0]);
  publisher.repair(session, request);
  tick();
  EXPECT_EQ(follower.chunks, 1U);
  EXPECT_EQ(publisher.stats().repairs, 1U);
  expect_whole_field_equal(session);
}

TEST_F(PublisherTest, slow_client_gets_no_poses_then_no_frames_then_a_reset) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  TrustingClient& follower = followers.at(session);
  backlog_bytes = limits::outbox_soft_bytes + 1;
  const size_t frames = follower.ticks.size();
  tick({source.carve({6.0F, 0.0F, 0.0F}, 1.0F, 2)});
  for (int i = 0; i < 6; ++i) tick();
  EXPECT_EQ(follower.ticks.size(), frames + 1);
  EXPECT_TRUE(follower.poses.empty());
  backlog_bytes = limits::outbox_resync_bytes + 1;
  tick();
  const Tick stopped = follower.ticks.back();
  backlog_bytes = 1;  // still not read everything
  tick({source.carve({3.0F, 0.0F, 0.0F}, 2.0F, 8)});
  EXPECT_EQ(follower.ticks.back(), stopped);
  backlog_bytes = 0;
  for (int i = 0; i < 60; ++i) tick();
  EXPECT_EQ(follower.resets, 1U);
  EXPECT_EQ(publisher.stats().resets, 1U);
  expect_whole_field_equal(session);
}

TEST_F(PublisherTest, while_nothing_happens_there_are_few_frames_and_one_before_each_status) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  for (int i = 0; i < 300; ++i) tick();
  const TrustingClient& follower = followers.at(session);
  EXPECT_LE(follower.ticks.size(), 11U) << "two a second, and the first";
  EXPECT_GE(follower.ticks.size(), 9U);
  ASSERT_EQ(follower.statuses.size(), 5U);
  for (const StatusMessage& status : follower.statuses)
    EXPECT_TRUE(std::ranges::find(follower.ticks, status.tick) != follower.ticks.end());
  const size_t before = follower.ticks.size();
  tick({source.carve({0.0F, 0.0F, 0.0F}, 1.0F, 4)});
  EXPECT_EQ(follower.ticks.size(), before + 1) << "at once";
}

TEST_F(PublisherTest, keyframe_out_of_sequence_starts_every_client_anew) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  const TickDelta keyframe = publisher.state().as_delta();
  const uint64_t hash = source.field().hash();
  for (int i = 0; i < 5; ++i) tick({source.carve({8.0F, 0.0F, static_cast<float>(i)}, 1.0F, 2)});
  deliver(keyframe);
  TickDelta next;
  for (int i = 0; i < 6; ++i) {
    next = publisher.state().as_delta();
    next.bricks.clear();
    next.spawned.clear();
    ++next.tick;
    deliver(next);
  }
  EXPECT_EQ(followers.at(session).resets, 1U);
  EXPECT_EQ(followers.at(session).field.hash(), hash);
  EXPECT_EQ(followers.at(session).pieces.size(), keyframe.pieces.size());
}

TEST_F(PublisherTest, a_tick_that_changes_more_than_a_frame_may_hold_is_streamed) {
  tick({source.carve({0.0F, 0.0F, 0.0F}, 0.5F, 1)});
  join(session, {0.0F, 0.0F, 0.0F}, 200.0F);
  change(flood());
  EXPECT_LE(followers.at(session).patches, limits::patch_bricks_max);
  for (int i = 0; i < 20; ++i) tick();
  EXPECT_EQ(followers.at(session).field.hash(), source.field().hash());
}

TEST_F(PublisherTest, replies_go_to_who_asked_and_status_comes_once_a_second) {
  join(1, {0.0F, 2.0F, 0.0F}, 64.0F);
  join(2, {0.0F, 2.0F, 0.0F}, 64.0F);
  TickDelta delta = *source.step();
  delta.work = {.budget_us = 12500, .estimate_us = 13000, .requests_waiting = 2};
  delta.replies.push_back({2, 77, "too large", 0});
  delta.replies.push_back({9, 1, "", 0});  // left meanwhile
  const ServerLatency told{1, 2, 3};
  latency = told;
  publisher.set_latency({told, {4, 5, 6}});
  deliver(delta);
  for (int i = 0; i < 120; ++i) tick();
  EXPECT_TRUE(followers.at(1).replies.empty());
  ASSERT_EQ(followers.at(2).replies.size(), 1U);
  EXPECT_EQ(followers.at(2).replies[0].request, 77U);
  EXPECT_EQ(followers.at(2).replies[0].refusal, "too large");
  EXPECT_EQ(followers.at(2).replies[0].latency, told);
  ASSERT_EQ(followers.at(1).statuses.size(), 2U);
  EXPECT_EQ(followers.at(1).statuses[0].clients, 2U);
  EXPECT_EQ(followers.at(1).statuses[0].latency, (LatencyStatus{told, {4, 5, 6}}));
  EXPECT_EQ(followers.at(1).statuses[0].work.requests_waiting, 2U);
  EXPECT_EQ(followers.at(1).statuses[0].work.ticks_cut_short, 1U);
  EXPECT_EQ(followers.at(1).statuses[1].work.ticks_cut_short, 0U) << "that was a second before";
}

TEST(TickClock, stages_are_means_over_the_last_second_in_the_order_of_the_table) {
  TickClock clock(2);
  ASSERT_EQ(clock.stages().size(), tick_stages.size());
  for (const double ms : {100.0, 3.0, 5.0}) {
    StageTimes times;
    times[TickStage::bodies] = ms;
    times[TickStage::support] = 2.0 * ms;
    clock.add(times, {});
  }
  const std::vector<StageTime> stages = clock.stages();
  for (size_t i = 0; i < tick_stages.size(); ++i) EXPECT_EQ(stages[i].name, tick_stages[i].name);
  EXPECT_FLOAT_EQ(stages[index_of(TickStage::bodies)].ms, 4.0F) << "the 100 ms left the window";
  EXPECT_FLOAT_EQ(stages[index_of(TickStage::support)].ms, 8.0F);
  EXPECT_EQ(stages[index_of(TickStage::requests)].ms, 0.0F);
  EXPECT_FLOAT_EQ(clock.worst_ms(), 15.0F);
}

TEST(TickClock, work_is_the_last_seconds) {
  TickClock clock(2);
  EXPECT_EQ(clock.work(), WorkStatus{});
  clock.add({}, {.budget_us = 12500,
                 .estimate_us = 90000,
                 .requests_waiting = 9,
                 .merges_put_off = 9,
                 .breaks_left_out = 9,
                 .dents_left_out = 9,
                 .merging_sooner = true});
  clock.add({}, {.budget_us = 12500,
                 .estimate_us = 14000,
                 .requests_waiting = 3,
                 .merges_put_off = 7,
                 .breaks_left_out = 2,
                 .merging_sooner = true,
                 .supports_put_off = 8,
                 .islands_put_off = 1,
                 .islands_too_large = 2});
  clock.add({}, {.budget_us = 12500,
                 .estimate_us = 9000,
                 .requests_waiting = 4,
                 .breaks_left_out = 5,
                 .dents_left_out = 1,
                 .supports_put_off = 6,
                 .islands_put_off = 3,
                 .islands_too_large = 1});
  EXPECT_EQ(clock.work(), (WorkStatus{12500, 14000, 4, 7, 7, 1, 2, 1, 8, 3, 3}))
      << "the first tick left the window";
}

TEST(PublishedPhysics, has_a_budget_of_bytes_and_goes_on_when_it_is_much) {
  TickSource source{flat_terrain};
  Workers workers(1);
  Publisher publisher({.terrain = flat_terrain}, workers);
  publisher.join(1, {}, 64.0F, operation_kinds);
  publisher.subscribe_physics(1, true);
  auto physics = std::make_shared<PhysicsMessage>();
  for (size_t i = 0; i < limits::physics_contacts_max; ++i)
    physics->contacts.push_back({{static_cast<float>(i % 60), 1.0F, 0.5F}, {0.0F, 1.0F, 0.0F}, 3.0F});
  size_t bytes = 0, messages = 0;
  constexpr Tick ticks = 600;
  for (Tick i = 1; i <= ticks; ++i) {
    auto delta = std::make_shared<TickDelta>(*source.step());
    if (i % ticks_per_physics == 0) delta->physics = physics;
    for (const Outgoing& outgoing : publisher.publish(*delta, [](uint64_t) { return Backlog{}; })) {
      const auto message = decode_server(std::span(*outgoing.bytes).subspan(length_prefix_bytes));
      if (!message || !std::holds_alternative<PhysicsMessage>(*message)) continue;
      bytes += outgoing.bytes->size();
      ++messages;
    }
  }
  EXPECT_GT(bytes / messages, limits::physics_bytes_per_tick * ticks_per_physics) << "one is over the budget";
  EXPECT_LE(bytes, limits::physics_bytes_per_tick * ticks + 2 * (bytes / messages));
  EXPECT_GE(bytes, limits::physics_bytes_per_tick * ticks / 2);
}

}  // namespace
}  // namespace scree
