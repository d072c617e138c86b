// A client's copy: frames applied, hashes checked, damage repaired, chunks and pieces coming and going, and a
// hostile server that gets an error, not a crash.
#include "client/mirror/mirror.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "client/mirror/limits.h"
#include "proto/motion_codec.h"
#include "proto/transforms.h"
#include "tests/support/flat_welcome.h"
#include "tests/support/tick_source.h"

namespace scree {
namespace {

uint32_t fold(uint64_t hash) {
  return static_cast<uint32_t>(hash >> 32U) ^ static_cast<uint32_t>(hash);
}

/// A client and the world that it follows, which is rebuilt here as a server would send it.
struct Pair {
  TickSource source{terrain_of_worlds(flat_terrain)};
  Mirror mirror{flat_welcome()};

  /// The next tick as a frame of operations.
  FrameMessage frame(const std::vector<Operation>& operations, bool with_poses = false) {
    const auto delta = source.step(operations);
    FrameMessage frame;
    frame.tick = delta->tick;
    frame.operations = operations;
    std::unordered_set<ChunkCoord, CoordHash> changed;
    for (const AppliedOperation& operation : delta->operations)
      changed.insert(operation.writes.begin(), operation.writes.end());
    uint64_t sum = 0;
    for (const ChunkCoord chunk : changed) sum += source.field().chunk_hash(chunk);
    frame.has_check = !changed.empty();
    frame.check = fold(sum);
    if (with_poses) frame.transforms = pack_transforms(delta->pieces);
    return frame;
  }
  ChunkMessage chunk(ChunkCoord coord) {
    ChunkMessage message;
    message.chunk = coord;
    message.version = source.tick();
    for (const BrickCoord brick : source.field().edited_bricks(coord))
      message.bricks.push_back({brick, source.field().brick(brick)});
    message.hash = source.field().chunk_hash(coord);
    return message;
  }
  CarveOperation carve(uint32_t seeds = 8) { return source.carve({1.0F, -0.5F, 1.0F}, 1.5F, seeds); }
};

TEST(Mirror, what_it_has_kept_is_taken_on_the_servers_word_and_followed) {
  Pair before;
  ASSERT_TRUE(before.mirror.apply(before.frame({before.carve()})));
  const auto find_cached = [&](ChunkCoord chunk) { return before.chunk(chunk).bricks; };
  Mirror mirror(flat_welcome(), find_cached);
  UnchangedChunksMessage message{before.source.field().edited_chunks(), {}};
  for (const ChunkCoord chunk : message.chunks)
    message.hashes.push_back(before.source.field().chunk_hash(chunk));
  const auto applied = mirror.apply(message);
  ASSERT_TRUE(applied);
  EXPECT_FALSE(applied->bricks.empty());
  EXPECT_EQ(mirror.field().hash(), before.source.field().hash());
  EXPECT_EQ(mirror.held_chunks().size(), message.chunks.size());
  EXPECT_FALSE(mirror.next_repair_request());
  ASSERT_TRUE(mirror.apply(before.frame({before.carve()})));
  EXPECT_EQ(mirror.mismatches(), 0U);
}

TEST(Mirror, what_it_has_not_kept_or_otherwise_than_the_server_means_is_asked_for) {
  Pair pair;
  ASSERT_TRUE(pair.mirror.apply(pair.frame({pair.carve()})));
  const ChunkCoord chunk = pair.source.field().edited_chunks().front();
  const auto other = [&](ChunkCoord) {
    return std::vector<BrickPatch>{{brick_in_chunk(chunk, 0), solid_brick()}};
  };
  for (const FindCachedChunk& find_cached : {FindCachedChunk(), FindCachedChunk(other)}) {
    Mirror mirror(flat_welcome(), find_cached);
    ASSERT_TRUE(mirror.apply(UnchangedChunksMessage{{chunk}, {pair.source.field().chunk_hash(chunk)}}));
    const auto repair = mirror.next_repair_request();
    ASSERT_TRUE(repair);
    EXPECT_EQ(repair->chunks, std::vector{chunk});
    EXPECT_EQ(repair->hashes, std::vector{mirror.field().chunk_hash(chunk)});
    EXPECT_FALSE(mirror.next_repair_request());
    ASSERT_TRUE(mirror.apply(pair.chunk(chunk)));
    EXPECT_EQ(mirror.field().chunk_hash(chunk), pair.source.field().chunk_hash(chunk));
    EXPECT_EQ(mirror.counters().repairs_arrived, 1U);
  }
}

TEST(Mirror, operations_give_the_same_hash_pieces_and_poses_as_on_the_server) {
  Pair pair;
  const auto carved = pair.mirror.apply(pair.frame({pair.carve()}));
  ASSERT_TRUE(carved) << carved.error().message;
  EXPECT_FALSE(carved->bricks.empty());
  EXPECT_EQ(carved->pieces_added.size(), pair.source.pieces().size());
  EXPECT_EQ(pair.mirror.pieces().size(), pair.source.pieces().size());
  EXPECT_EQ(pair.mirror.field().hash(), pair.source.field().hash());

  const PieceId first = pair.source.pieces().begin()->first;
  const auto stamped = pair.mirror.apply(pair.frame({pair.source.stamp(first)}));
  ASSERT_TRUE(stamped) << stamped.error().message;
  EXPECT_EQ(stamped->pieces_removed, std::vector<PieceId>{first});
  EXPECT_EQ(pair.mirror.field().hash(), pair.source.field().hash());
  EXPECT_EQ(pair.mirror.mismatches(), 0U);
  EXPECT_EQ(pair.mirror.counters().checks, 2U);
  EXPECT_EQ(pair.mirror.counters().operations.of<CarveOperation>(), 1U);
  EXPECT_EQ(pair.mirror.counters().pieces_merged, 1U);
  EXPECT_FALSE(pair.mirror.next_repair_request());
  for (const ChunkCoord chunk : pair.source.field().edited_chunks())
    EXPECT_TRUE(pair.mirror.held_chunks().contains(chunk));
}

TEST(Mirror, children_of_a_piece_that_shatters_start_where_it_was_seen) {
  Pair pair;
  ASSERT_TRUE(pair.mirror.apply(pair.frame({pair.carve(1)})));
  const PieceId parent = pair.source.pieces().begin()->first;
  pair.source.move(parent, {3.0F, 7.0F, 0.0F});
  ASSERT_TRUE(pair.mirror.apply(pair.frame({}, true)));
  const glm::vec3 centre = pair.source.pieces().at(parent)->centre_voxels;
  const auto broken =
      pair.mirror.apply(pair.frame({ShatterOperation{parent, SeedPattern::uniform, 4, 1, centre, 50}}));
  ASSERT_TRUE(broken) << broken.error().message;
  EXPECT_EQ(broken->pieces_removed, std::vector<PieceId>{parent});
  EXPECT_EQ(broken->pieces_added.size(), 4U);
  EXPECT_EQ(pair.mirror.counters().operations.of<ShatterOperation>(), 1U);
  for (const auto& [id, motion] : pair.mirror.pieces()) {
    const glm::vec3 cut_m = motion.volume->centre_voxels * voxel_m;
    EXPECT_NEAR(glm::distance(motion.to.position_m, cut_m + glm::vec3(3.0F, 7.0F, 0.0F)), 0.0F, 0.01F);
  }
}

TEST(Mirror, a_mismatch_asks_for_the_chunks_and_a_chunk_message_repairs_them) {
  Pair pair;
  ASSERT_TRUE(pair.mirror.apply(pair.frame({pair.carve()})));
  const BrickCoord brick =
      pair.source.field().edited_bricks(pair.source.field().edited_chunks().front()).front();
  Brick damaged = pair.mirror.field().brick(brick);
  damaged.codes[100] = static_cast<Code>(damaged.codes[100] == 5 ? 6 : 5);
  pair.mirror.field().set_brick(brick, damaged);

  const PieceId first = pair.source.pieces().begin()->first;
  FrameMessage frame = pair.frame({pair.source.stamp(first)});
  frame.patches = {{brick, damaged}};  // so that the damaged chunk is among those checked
  ASSERT_TRUE(pair.mirror.apply(frame));
  EXPECT_EQ(pair.mirror.mismatches(), 1U);
  const auto request = pair.mirror.next_repair_request();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->tick, frame.tick);
  ASSERT_EQ(request->chunks.size(), request->hashes.size());
  EXPECT_FALSE(pair.mirror.next_repair_request()) << "asked once";
  bool found = false;
  for (size_t i = 0; i < request->chunks.size(); ++i) {
    EXPECT_EQ(request->hashes[i], pair.mirror.field().chunk_hash(request->chunks[i]));
    if (request->hashes[i] == pair.source.field().chunk_hash(request->chunks[i])) continue;
    found = found || request->chunks[i] == chunk_of(brick);
    ASSERT_TRUE(pair.mirror.apply(pair.chunk(request->chunks[i])));
  }
  EXPECT_TRUE(found);
  EXPECT_EQ(pair.mirror.field().hash(), pair.source.field().hash());
  EXPECT_GE(pair.mirror.counters().repairs_arrived, 1U);
}

TEST(Mirror, a_chunk_under_repair_is_not_asked_for_again_at_every_frame) {
  Pair pair;
  FrameMessage frame = pair.frame({pair.carve()});
  frame.check ^= 1U;
  ASSERT_TRUE(pair.mirror.apply(frame));
  ASSERT_TRUE(pair.mirror.next_repair_request());
  frame = pair.frame({pair.source.stamp(pair.source.pieces().begin()->first)});
  frame.check ^= 1U;
  ASSERT_TRUE(pair.mirror.apply(frame));
  EXPECT_EQ(pair.mirror.mismatches(), 2U);
  const auto again = pair.mirror.next_repair_request();
  for (const ChunkCoord chunk : again ? again->chunks : std::vector<ChunkCoord>{})
    EXPECT_FALSE(chunk_of(VoxelCoord{4, -2, 4}) == chunk);
}

TEST(Mirror, a_repair_that_does_not_come_is_asked_for_again_in_the_end) {
  Pair pair;
  FrameMessage frame = pair.frame({pair.carve()});
  frame.check ^= 1U;
  ASSERT_TRUE(pair.mirror.apply(frame));
  const auto first = pair.mirror.next_repair_request();
  ASSERT_TRUE(first);
  for (Tick tick = 0; tick < limits::repair_patience_ticks; ++tick)
    ASSERT_TRUE(pair.mirror.apply(pair.frame({})));
  frame = pair.frame({pair.source.carve({1.0F, -0.5F, 1.0F}, 2.0F, 8)});  // a wider one, in the same chunks
  frame.check ^= 1U;
  ASSERT_TRUE(pair.mirror.apply(frame));
  const auto again = pair.mirror.next_repair_request();
  ASSERT_TRUE(again);
  for (const ChunkCoord chunk : first->chunks)
    EXPECT_TRUE(std::ranges::find(again->chunks, chunk) != again->chunks.end());
  EXPECT_EQ(again->tick, frame.tick);
}

TEST(Mirror, patches_stand_in_for_an_operation_that_was_not_sent) {
  Pair pair;
  const auto delta = pair.source.step({pair.carve()});
  FrameMessage frame;
  frame.tick = delta->tick;
  for (const BrickState& brick : delta->bricks) frame.patches.push_back({brick.coord, *brick.brick});
  frame.has_check = true;
  frame.check = fold(pair.source.field().hash());
  ASSERT_TRUE(pair.mirror.apply(frame));
  EXPECT_EQ(pair.mirror.field().hash(), pair.source.field().hash());
  EXPECT_EQ(pair.mirror.mismatches(), 0U);
  EXPECT_EQ(pair.mirror.counters().patched_bricks, delta->bricks.size());
  EXPECT_TRUE(pair.mirror.pieces().empty());
}

TEST(Mirror, a_dropped_chunk_reads_as_generated_and_is_no_longer_held) {
  Pair pair;
  ASSERT_TRUE(pair.mirror.apply(pair.frame({pair.carve()})));
  FrameMessage frame = pair.frame({});
  frame.dropped_chunks = pair.source.field().edited_chunks();
  const auto changes = pair.mirror.apply(frame);
  ASSERT_TRUE(changes);
  EXPECT_FALSE(changes->bricks.empty());
  EXPECT_TRUE(pair.mirror.held_chunks().empty());
  EXPECT_EQ(pair.mirror.field().hash(), 0U);
  for (const ChunkCoord chunk : pair.source.field().edited_chunks())
    ASSERT_TRUE(pair.mirror.apply(pair.chunk(chunk)));
  EXPECT_EQ(pair.mirror.field().hash(), pair.source.field().hash());
}

TEST(Mirror, a_chunk_replaces_whatever_edits_were_there) {
  Pair pair;
  const auto delta = pair.source.step({pair.carve()});
  const ChunkCoord coord = pair.source.field().edited_chunks().front();
  pair.mirror.field().set_brick(first_brick(coord), solid_brick());
  pair.mirror.field().set_brick(brick_in_chunk(coord, 63), air_brick());
  ASSERT_TRUE(pair.mirror.apply(pair.chunk(coord)));
  EXPECT_EQ(pair.mirror.field().chunk_hash(coord), pair.source.field().chunk_hash(coord));
}

TEST(Mirror, a_chunk_with_a_wrong_hash_is_an_error) {
  Pair pair;
  pair.source.step({pair.carve()});
  ChunkMessage message = pair.chunk(pair.source.field().edited_chunks().front());
  message.hash ^= 1U;
  EXPECT_FALSE(pair.mirror.apply(message));
}

TEST(Mirror, a_piece_that_was_sent_whole_can_be_stamped) {
  Pair pair;
  pair.source.step({pair.carve()});
  for (const ChunkCoord chunk : pair.source.field().edited_chunks())
    ASSERT_TRUE(pair.mirror.apply(pair.chunk(chunk)));
  const auto& [id, volume] = *pair.source.pieces().begin();
  ASSERT_TRUE(pair.mirror.apply(PieceMessage{id, *volume, pair.source.stamp(id).pose}));
  ASSERT_TRUE(pair.mirror.apply(pair.frame({pair.source.stamp(id)})));
  EXPECT_EQ(pair.mirror.field().hash(), pair.source.field().hash());
  EXPECT_EQ(pair.mirror.mismatches(), 0U);
}

TEST(Mirror, poses_are_interpolated_between_the_last_two_and_clamped) {
  Pair pair;
  ASSERT_TRUE(pair.mirror.apply(pair.frame({pair.carve()})));
  const PieceId id = pair.source.pieces().begin()->first;
  ASSERT_TRUE(pair.mirror.apply(pair.frame({}, true)));
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(pair.mirror.apply(pair.frame({})));
  pair.source.move(id, {3.0F, 0.0F, 0.0F});
  ASSERT_TRUE(pair.mirror.apply(pair.frame({}, true)));
  const PieceMotion& motion = pair.mirror.pieces().at(id);
  ASSERT_EQ(motion.to_tick - motion.from_tick, 3U);
  const float start = motion.from.position_m.x;
  EXPECT_NEAR(motion.to.position_m.x - start, 3.0F, 0.002F);
  const auto x_at = [&](double after) {
    return pair.mirror.pose_at(motion, static_cast<double>(motion.from_tick) + after).position_m.x - start;
  };
  EXPECT_NEAR(x_at(-5.0), 0.0F, 1e-4F);
  EXPECT_NEAR(x_at(1.5), 1.5F, 0.002F);
  EXPECT_NEAR(x_at(9.0), 3.0F, 0.002F);
}

TEST(Mirror, a_piece_that_lay_still_starts_to_move_one_interval_before_its_next_pose) {
  Pair pair;
  ASSERT_TRUE(pair.mirror.apply(pair.frame({pair.carve()}, true)));
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(pair.mirror.apply(pair.frame({})));
  const PieceId id = pair.source.pieces().begin()->first;
  pair.source.move(id, {0.0F, 1.0F, 0.0F});
  ASSERT_TRUE(pair.mirror.apply(pair.frame({}, true)));
  const PieceMotion& motion = pair.mirror.pieces().at(id);
  EXPECT_EQ(motion.to_tick - motion.from_tick, flat_welcome().ticks_per_transform);
}

TEST(Mirror, motions_take_pieces_further_from_where_they_were_born) {
  Pair pair;
  ASSERT_TRUE(pair.mirror.apply(pair.frame({pair.carve()})));
  std::vector<Motion> born;
  for (const auto& [id, volume] : pair.source.pieces())
    born.push_back(born_at(volume->centre_voxels * flat_terrain.voxel_size_m));
  const std::optional<Correction> none, pushed = Correction{MotionMode::slide, {200, 0, 0}, {}};
  std::vector<MotionStep> steps;
  for (const auto& [id, volume] : pair.source.pieces()) {
    const Motion& motion = born[steps.size()];
    steps.push_back({id, &motion, motion_check(id, motion), steps.empty() ? &pushed : &none});
  }
  const PieceMotion before = pair.mirror.pieces().begin()->second;
  FrameMessage frame = pair.frame({});
  frame.motions = encode_motions({}, steps);
  const auto applied = pair.mirror.apply(frame);
  ASSERT_TRUE(applied) << applied.error().message;
  const PieceMotion& motion = pair.mirror.pieces().begin()->second;
  EXPECT_NEAR(motion.to.position_m.x - before.to.position_m.x, 200.0F * 3.0F * 37.0F / 16384.0F, 1e-3F);
  EXPECT_EQ(motion.to_tick, frame.tick);
  EXPECT_EQ(pair.mirror.counters().transforms, pair.source.pieces().size());
  EXPECT_EQ(pair.mirror.counters().transform_bytes, frame.motions.size());
  EXPECT_FALSE(pair.mirror.apply(frame)) << "the motions have gone on";
}

TEST(Mirror, a_reset_forgets_everything_and_lets_the_tick_go_back) {
  Pair pair;
  ASSERT_TRUE(pair.mirror.apply(pair.frame({pair.carve()})));
  ASSERT_TRUE(pair.mirror.apply(ResetMessage{}));
  EXPECT_TRUE(pair.mirror.pieces().empty());
  EXPECT_TRUE(pair.mirror.held_chunks().empty());
  EXPECT_EQ(pair.mirror.field().hash(), 0U);
  FrameMessage frame;
  frame.tick = 1;
  EXPECT_TRUE(pair.mirror.apply(frame));
}

TEST(Mirror, what_a_hostile_server_sends_is_an_error_and_not_a_crash) {
  const auto refuses = [](const ServerMessage& message) {
    Pair pair;
    EXPECT_TRUE(pair.mirror.apply(pair.frame({pair.carve()})));
    return !pair.mirror.apply(message).has_value();
  };
  FrameMessage frame;
  frame.tick = 2;
  frame.operations = {StampOperation{99999, {}, 0}};
  EXPECT_TRUE(refuses(frame)) << "a stamp of an unknown piece";
  frame.operations = {DiscardOperation{99999}};
  EXPECT_TRUE(refuses(frame)) << "a discard of an unknown piece";
  frame.operations = {FillOperation{sphere({0, 0, 0}, 1000.0F)}};
  EXPECT_TRUE(refuses(frame)) << "a fill over the limit";
  frame.operations = {CarveOperation{sphere({0, -1, 0}, 1.0F), SeedPattern::uniform, 4, 0, {}, 1}};
  EXPECT_TRUE(refuses(frame)) << "pieces that are there already";
  frame.operations = {};
  frame.transforms = pack_transforms(std::vector<PieceState>{{99999, {}}});
  EXPECT_TRUE(refuses(frame)) << "the pose of an unknown piece";
  frame.transforms = {1, 2};
  EXPECT_TRUE(refuses(frame)) << "poses cut short";
  frame.transforms = {};
  const WholeMotion of_nobody[] = {{99999, resting_at({})}};
  frame.motions = encode_motions(of_nobody, {});
  EXPECT_TRUE(refuses(frame)) << "the motion of an unknown piece";
  frame.motions = {3, 1, 4, 1, 5};
  EXPECT_TRUE(refuses(frame)) << "motions of other pieces";
  frame.motions = {};
  frame.tick = 0;
  EXPECT_TRUE(refuses(frame)) << "a frame of the past";
  EXPECT_TRUE(refuses(WelcomeMessage{})) << "a second welcome";
  EXPECT_TRUE(refuses(RefusalMessage{"enough"})) << "a refusal";
}

TEST(Mirror, a_chunk_that_is_dropped_is_no_longer_awaited) {
  Pair pair;
  FrameMessage frame = pair.frame({pair.carve()});
  frame.check ^= 1U;
  ASSERT_TRUE(pair.mirror.apply(frame));
  const auto first = pair.mirror.next_repair_request();
  ASSERT_TRUE(first);
  frame = pair.frame({});
  frame.dropped_chunks = pair.source.field().edited_chunks();
  ASSERT_TRUE(pair.mirror.apply(frame));
  const auto delta = pair.source.step({});
  frame = {};
  frame.tick = delta->tick;
  for (const ChunkCoord chunk : pair.source.field().edited_chunks())
    for (const BrickPatch& patch : pair.chunk(chunk).bricks) frame.patches.push_back(patch);
  frame.has_check = true;
  frame.check = fold(pair.source.field().hash()) ^ 1U;
  ASSERT_TRUE(pair.mirror.apply(frame));
  const auto again = pair.mirror.next_repair_request();
  ASSERT_TRUE(again) << "it comes anew, and nobody has asked for it yet";
  EXPECT_EQ(again->chunks.size(), first->chunks.size());
}

}  // namespace
}  // namespace scree
