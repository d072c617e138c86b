// Pieces that rest together become terrain in one pass: the mass of all, the same bits everywhere.
#include <algorithm>
#include <gtest/gtest.h>

#include "bench/support/scenes.h"
#include "client/mirror/mirror.h"
#include "server/world/world.h"
#include "shared/base/limits.h"
#include "shared/operation/prepared_stamp.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

/// A ball out of the ground in two dozen pieces, and these where they were.
struct Heap {
  MapField field{{TerrainKind::noise, 3, voxel_m}};
  PieceTable pieces;
  std::vector<StampedPiece> places;

  Heap() {
    const glm::vec3 centre(0.0F, ground_height_m(field.source(), 0.0F, 0.0F) - 0.5F, 0.0F);
    apply(CarveOperation{sphere(centre, 1.4F), SeedPattern::uniform, 24, 7, centre, 1}, field, pieces);
    for (const auto& [id, volume] : pieces)
      places.push_back({id, quantise({volume->centre_voxels * voxel_m, glm::quat(1.0F, 0.0F, 0.0F, 0.0F)})});
  }
  /// So many of the places from one on; fewer at the end.
  std::vector<StampedPiece> group(size_t first, size_t count) const {
    const size_t last = std::min(first + count, places.size());
    return {places.begin() + static_cast<ptrdiff_t>(first), places.begin() + static_cast<ptrdiff_t>(last)};
  }
};

StampOperation operation_of(const std::vector<StampedPiece>& group) {
  return {group.front().piece, group.front().pose, 0, StampMethod::stamp, {group.begin() + 1, group.end()}};
}

void merge_in_groups(StampMethod method) {
  for (const size_t together : {size_t{2}, size_t{5}, limits::stamp_group_max}) {
    Heap with, without;
    MassUnits all = 0, gained = 0;
    for (size_t first = 0; first < with.places.size(); first += together) {
      const std::vector<StampedPiece> group = with.group(first, together);
      MassUnits mass = 0;
      for (const StampedPiece& one : group) mass += with.pieces.at(one.piece)->mass;
      const PreparedStamp prepared = prepare_group(with.field, with.pieces, group, method, mass);
      ASSERT_TRUE(validate(prepared.operation, with.pieces, voxel_m).has_value());
      const VoxelBox reads = read_box(prepared.operation, with.pieces, voxel_m);
      const Applied a = apply(prepared.operation, with.field, with.pieces, &prepared);
      const Applied b = apply(prepared.operation, without.field, without.pieces);
      EXPECT_EQ(a.terrain_gain, prepared.gain);
      EXPECT_EQ(a.terrain_gain, b.terrain_gain);
      all += mass;
      gained += a.terrain_gain;
      ASSERT_EQ(with.field.hash(), without.field.hash());
      for (const BrickCoord brick : a.changed) {
        const VoxelCoord v = first_voxel(brick);
        EXPECT_FALSE(common(reads, {v, v + VoxelCoord{brick_size, brick_size, brick_size}}).empty());
      }
    }
    // Not each group's to a thousandth: the last fill a hole in which there is less room, or more.
    EXPECT_LE(std::abs(gained - all) * 100, all);
    EXPECT_TRUE(with.pieces.empty());
    EXPECT_TRUE(without.pieces.empty());
  }
}

TEST(group_merge, a_group_gains_what_was_planned_whoever_works_it_out_and_changes_no_more_than_it_reads) {
  for (const StampMethod method : kinds_that<StampMethod, lays>) {
    SCOPED_TRACE(name_of(method));
    merge_in_groups(method);
  }
}

TEST(group_merge, what_lies_apart_merges_as_it_would_alone) {
  Heap together, alone;
  const StampedPiece& near = together.places[0];
  StampedPiece far = together.places[1];
  far.pose.x = near.pose.x + static_cast<int32_t>(2.9F * pose_steps_per_m);
  StampOperation op = operation_of({near, far});
  ASSERT_TRUE(validate(op, together.pieces, voxel_m).has_value());
  apply(op, together.field, together.pieces);
  apply(operation_of({near}), alone.field, alone.pieces);
  apply(operation_of({far}), alone.field, alone.pieces);
  // The mass is met as a whole, so single codes may lie elsewhere.
  const VoxelBox all = read_box(op, Heap().pieces, voxel_m);
  const Window a = gather(together.field, all), b = gather(alone.field, all);
  size_t sides = 0;
  for (size_t i = 0; i < a.codes.size(); ++i) sides += (a.codes[i] < 0) != (b.codes[i] < 0) ? 1 : 0;
  EXPECT_EQ(sides, 0U);
}

TEST(group_merge, every_piece_of_a_group_is_there_though_their_boxes_overlap) {
  Heap heap;
  const std::vector<StampedPiece> group = heap.group(0, limits::stamp_group_max);
  PieceTable pieces = heap.pieces;
  apply(operation_of(group), heap.field, heap.pieces);
  for (const StampedPiece& one : group) {
    const Window& window = pieces.at(one.piece)->window;
    const Window after = gather(heap.field, window.box);
    for (size_t i = 0; i < window.codes.size(); ++i) {
      if (window.codes[i] > -60) continue;  // well within the piece
      ASSERT_LT(after.codes[i], 0) << "rock of piece " << one.piece << " is missing";
    }
  }
}

TEST(group_merge, groups_that_may_not_merge_together_are_refused_by_name) {
  const Heap heap;
  const auto refused = [&](const StampOperation& op, const char* why) {
    const Result<void> valid = validate(op, heap.pieces, voxel_m);
    ASSERT_FALSE(valid);
    EXPECT_NE(valid.error().message.find(why), std::string::npos) << valid.error().message;
  };
  const StampOperation fine = operation_of(heap.group(0, limits::stamp_group_max));
  EXPECT_TRUE(validate(fine, heap.pieces, voxel_m).has_value());
  refused(operation_of(heap.group(0, limits::stamp_group_max + 1)), "limits.stamp_group_max");
  StampOperation op = fine;
  op.method = StampMethod::slices;
  refused(op, "one piece at a time");
  op = fine;
  op.others[1].piece = op.piece;
  refused(op, "stamped twice");
  op.others[1].piece = 777;
  refused(op, "no piece 777");
  op = fine;
  op.others[1].pose.x += static_cast<int32_t>((limits::stamp_group_reach_max_m + 4.0F) * pose_steps_per_m);
  refused(op, "too far apart");
  op.others[1].pose.x = 1 << 30;
  refused(op, "outside the world");
}

struct Merges {
  int64_t operations = 0, pieces = 0;
};

/// A blow in a world, until nothing is left; a mirror follows it.
Merges settle(bool group_merges) {
  WorldConfig config;
  config.methods.group_merges = group_merges;
  World world(config);
  WelcomeMessage welcome;
  welcome.terrain = world.config().terrain;
  Mirror mirror(welcome);
  std::vector<Command> commands{{1, 1, blow_at(config.terrain, 12.0F, 12.0F, 2.0F, 64, 3)}};
  Merges merges;
  for (int tick = 0; tick < 1800; ++tick) {
    const auto delta = world.step(commands);
    commands.clear();
    FrameMessage frame;
    frame.tick = delta->tick;
    for (const AppliedOperation& applied : delta->operations) {
      frame.operations.push_back(applied.operation);
      const auto pieces = static_cast<int64_t>(pieces_merged_by(applied.operation));
      merges.pieces += pieces;
      merges.operations += pieces > 0 ? 1 : 0;
    }
    EXPECT_TRUE(mirror.apply(frame));
    EXPECT_EQ(mirror.field().hash(), delta->field_hash) << "tick " << delta->tick;
    EXPECT_EQ(delta->ledger.error(), 0);
    if (delta->pieces.empty()) break;
  }
  EXPECT_EQ(mirror.counters().pieces_merged, static_cast<uint64_t>(merges.pieces));
  return merges;
}

TEST(group_merge, a_world_merges_what_rests_together_in_fewer_operations_only_when_it_is_switched_on) {
  const Merges one_by_one = settle(false), grouped = settle(true);
  EXPECT_GE(one_by_one.pieces, 32);
  EXPECT_EQ(one_by_one.operations, one_by_one.pieces);
  EXPECT_GE(grouped.pieces, 32);
  EXPECT_LT(grouped.operations, grouped.pieces);
}

}  // namespace
}  // namespace scree
