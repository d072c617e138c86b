// The publisher's selection, without sockets: what each client gets suffices to have the server's field.
#include "server/net/publisher.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "proto/codec.h"
#include "proto/transforms.h"
#include "server/net/limits.h"
#include "tests/support/tick_source.h"

namespace scree {
namespace {

constexpr uint64_t session = 1;
const TerrainSource flat{TerrainKind::flat, 1, 0.25F};

/// A client that believes every message, and checks each frame's check.
class Follower {
 public:
  void take(const Outgoing& outgoing) {
    const std::span<const uint8_t> bytes(*outgoing.bytes);
    const auto message = decode_server(bytes.subspan(length_prefix_bytes));
    ASSERT_TRUE(message.has_value()) << message.error().message;
    std::visit([this](const auto& m) { apply(m); }, *message);
  }

  MapField field{flat};
  PieceTable pieces;
  std::vector<Tick> ticks;
  size_t operations = 0, patches = 0, chunks = 0, piece_messages = 0, resets = 0, drops = 0, mismatches = 0;
  std::map<PieceId, QuantisedPose> poses;
  std::vector<ReplyMessage> replies;
  std::vector<StatusMessage> statuses;

 private:
  void apply(const FrameMessage& frame) {
    ticks.push_back(frame.tick);
    std::map<ChunkCoord, bool> changed;
    for (const Operation& operation : frame.operations) {
      ++operations;
      ASSERT_TRUE(validate(operation, pieces, flat.voxel_size_m).has_value());
      for (const BrickCoord brick : scree::apply(operation, field, pieces).changed)
        changed[chunk_of(brick)] = true;
    }
    for (const BrickPatch& patch : frame.patches) {
      ++patches;
      field.set_brick(patch.coord, patch.brick);
      field.paint_brick(patch.coord, patch.paint);
      changed[chunk_of(patch.coord)] = true;
    }
    for (const ChunkCoord chunk : frame.dropped_chunks) {
      ++drops;
      field.forget_chunk(chunk);
    }
    for (const PieceId piece : frame.removed_pieces) EXPECT_EQ(pieces.erase(piece), 1U);
    const auto moved = unpack_transforms(frame.transforms);
    ASSERT_TRUE(moved.has_value());
    for (const PieceState& piece : *moved) {
      EXPECT_TRUE(pieces.contains(piece.id));
      poses[piece.id] = piece.pose;
    }
    uint64_t sum = 0;
    for (const auto& [chunk, yes] : changed) sum += field.chunk_hash(chunk);
    EXPECT_EQ(frame.has_check, !changed.empty());
    const uint32_t check = static_cast<uint32_t>(sum >> 32U) ^ static_cast<uint32_t>(sum);
    if (frame.has_check && frame.check != check) ++mismatches;
  }
  void apply(const ChunkMessage& message) {
    ++chunks;
    field.forget_chunk(message.chunk);
    for (const BrickPatch& patch : message.bricks) {
      field.set_brick(patch.coord, patch.brick);
      field.paint_brick(patch.coord, patch.paint);
    }
    EXPECT_EQ(field.chunk_hash(message.chunk), message.hash);
  }
  void apply(const PieceMessage& message) {
    ++piece_messages;
    EXPECT_FALSE(pieces.contains(message.id));
    pieces[message.id] = std::make_shared<const Volume>(message.volume);
    poses[message.id] = message.pose;
  }
  void apply(const ResetMessage&) {
    ++resets;
    for (const ChunkCoord chunk : field.edited_chunks()) field.forget_chunk(chunk);
    pieces.clear();
  }
  void apply(const ReplyMessage& message) { replies.push_back(message); }
  void apply(const StatusMessage& message) { statuses.push_back(message); }
  void apply(const WelcomeMessage&) { ADD_FAILURE() << "a welcome is not the publisher's"; }
  void apply(const RefusalMessage&) { ADD_FAILURE() << "a refusal is not the publisher's"; }
  void apply(const CursorsMessage&) { ADD_FAILURE() << "cursors are not the publisher's"; }
  void apply(const PhysicsMessage&) { ADD_FAILURE() << "what bodies do is not the publisher's"; }
};

class PublisherTest : public ::testing::Test {
 protected:
  void tick(const std::vector<Operation>& operations = {}) { deliver(*source.step(operations)); }
  void deliver(const TickDelta& delta) {
    const auto backlog = [this](uint64_t id) { return id == session ? backlog_bytes : 0; };
    for (const Outgoing& outgoing : publisher.publish(delta, backlog)) {
      bytes[outgoing.session] += outgoing.bytes->size();
      last[outgoing.session] = outgoing.bytes;
      followers[outgoing.session].take(outgoing);
    }
  }
  void join(uint64_t id, glm::vec3 eye_m, float radius_m) {
    publisher.join(id, eye_m, radius_m);
    followers.try_emplace(id);
  }
  /// Every chunk that the client holds reads as the server's.
  void expect_held_equal(uint64_t id) {
    for (const ChunkCoord chunk : publisher.view(id)->held())
      EXPECT_EQ(followers.at(id).field.chunk_hash(chunk), source.field().chunk_hash(chunk));
  }
  void expect_whole_field_equal(uint64_t id) {
    EXPECT_EQ(followers.at(id).field.hash(), source.field().hash());
    EXPECT_EQ(followers.at(id).pieces.size(), source.pieces().size());
    EXPECT_EQ(followers.at(id).mismatches, 0U);
  }

  TickSource source{flat};
  Publisher publisher{PublisherConfig{}};
  std::map<uint64_t, Follower> followers;
  std::map<uint64_t, size_t> bytes;
  std::map<uint64_t, SharedBytes> last;
  size_t backlog_bytes = 0;
};

TEST_F(PublisherTest, client_from_the_start_gets_operations_and_no_bricks) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  tick({source.carve({1.0F, 0.0F, 1.0F}, 1.5F, 4)});
  tick({source.stamp(1), source.stamp(2)});
  const Follower& follower = followers.at(session);
  EXPECT_EQ(follower.operations, 4U);
  EXPECT_EQ(follower.patches + follower.chunks + follower.piece_messages, 0U);
  expect_whole_field_equal(session);
}

TEST_F(PublisherTest, late_joiner_gets_chunks_and_pieces_and_then_follows_by_operations) {
  for (int i = 0; i < 6; ++i) tick({source.carve({static_cast<float>(4 * i), 0.0F, 0.0F}, 1.5F, 6)});
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  for (int i = 0; i < 60; ++i) tick();
  Follower& follower = followers.at(session);
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
  const Follower& follower = followers.at(session);
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

TEST_F(PublisherTest, equal_clients_share_the_same_bytes) {
  join(1, {0.0F, 2.0F, 0.0F}, 64.0F);
  join(2, {1.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  EXPECT_EQ(last.at(1).get(), last.at(2).get());
}

TEST_F(PublisherTest, only_moved_pieces_have_transforms) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 8)});
  for (int i = 0; i < 3; ++i) tick();
  Follower& follower = followers.at(session);
  follower.poses.clear();
  source.move(3, {0.0F, 1.0F, 0.0F});
  for (int i = 0; i < 6; ++i) tick();
  ASSERT_EQ(follower.poses.size(), 1U);
  EXPECT_TRUE(follower.poses.contains(3));
}

TEST_F(PublisherTest, repair_resends_exactly_the_chunks_that_differ) {
  join(session, {0.0F, 2.0F, 0.0F}, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 4)});
  Follower& follower = followers.at(session);
  RepairRequest request;
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
  Follower& follower = followers.at(session);
  backlog_bytes = limits::outbox_soft_bytes + 1;
  for (int i = 0; i < 6; ++i) tick();
  EXPECT_EQ(follower.ticks.back(), source.tick());
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
  TickDelta delta = publisher.state().as_delta();
  ++delta.tick;
  delta.spawned.clear();
  for (int x = 0; x < 30; ++x)
    for (int z = 0; z < 60; ++z) {
      const BrickCoord coord{x, 0, z};
      source.field().set_brick(coord, solid_brick());
      delta.bricks.push_back(
          {coord, std::make_shared<const Brick>(solid_brick()), brick_hash(coord, solid_brick())});
    }
  std::ranges::sort(delta.bricks, {}, &BrickState::coord);
  const auto same = [](const BrickState& a, const BrickState& b) { return a.coord == b.coord; };
  delta.bricks.erase(std::unique(delta.bricks.begin(), delta.bricks.end(), same), delta.bricks.end());
  for (BrickState& brick : delta.bricks) {
    brick.brick = std::make_shared<const Brick>(source.field().brick(brick.coord));
    brick.hash = brick_hash(brick.coord, *brick.brick);
  }
  delta.field_hash = source.field().hash();
  deliver(delta);
  EXPECT_LE(followers.at(session).patches, limits::patch_bricks_max);
  for (int i = 0; i < 20; ++i) {
    ++delta.tick;
    delta.bricks.clear();
    deliver(delta);
  }
  EXPECT_EQ(followers.at(session).field.hash(), source.field().hash());
}

TEST_F(PublisherTest, replies_go_to_who_asked_and_status_comes_once_a_second) {
  join(1, {0.0F, 2.0F, 0.0F}, 64.0F);
  join(2, {0.0F, 2.0F, 0.0F}, 64.0F);
  TickDelta delta = *source.step();
  delta.work = {12500, 13000, 2, 0, 0, 0, false};
  delta.replies.push_back({2, 77, "too large", 0});
  delta.replies.push_back({9, 1, "", 0});  // left meanwhile
  deliver(delta);
  for (int i = 0; i < 120; ++i) tick();
  EXPECT_TRUE(followers.at(1).replies.empty());
  ASSERT_EQ(followers.at(2).replies.size(), 1U);
  EXPECT_EQ(followers.at(2).replies[0].request, 77U);
  EXPECT_EQ(followers.at(2).replies[0].refusal, "too large");
  ASSERT_EQ(followers.at(1).statuses.size(), 2U);
  EXPECT_EQ(followers.at(1).statuses[0].clients, 2U);
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
  EXPECT_EQ(stages[index_of(TickStage::carve)].ms, 0.0F);
  EXPECT_FLOAT_EQ(clock.worst_ms(), 15.0F);
}

TEST(TickClock, work_is_the_last_seconds) {
  TickClock clock(2);
  EXPECT_EQ(clock.work(), WorkStatus{});
  clock.add({}, {12500, 90000, 9, 9, 9, 9, true});
  clock.add({}, {12500, 14000, 3, 7, 2, 0, true, 8, 0, 1, 2});
  clock.add({}, {12500, 9000, 4, 0, 5, 1, false, 6, 0, 3, 1});
  EXPECT_EQ(clock.work(), (WorkStatus{12500, 14000, 4, 7, 7, 1, 2, 1, 8, 3, 3}))
      << "the first tick left the window";
}

}  // namespace
}  // namespace scree
