#include "client/render/scene/settled_stones.h"

#include <gtest/gtest.h>

#include "client/render/scene/limits.h"
#include "shared/operation/operation.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

/// A block of rock cut in one piece, which lies five metres beside its hole, a quarter turned.
class SettledStonesTest : public testing::Test {
 protected:
  void SetUp() override {
    const Shape ball{ShapeKind::sphere, {0.0F, 0.0F, 0.0F}, glm::vec3(0.0F), 1.5F};
    apply(Operation(CarveOperation{ball, SeedPattern::uniform, 1, 5, {}, 1}), field_, table_);
    ASSERT_EQ(table_.size(), 1U);
    pieces_[1] = {table_.at(1), quantised_pose({5.0F, 0.3F, 0.0F})};
    MirrorChanges none;
    stones_.step(pieces_, field_, eye_m_, none);
  }
  static Pose quantised_pose(glm::vec3 at_m) {
    return dequantise(quantise(Pose{at_m, {0.7071F, 0.0F, 0.7071F, 0.0F}}));
  }
  /// The piece is gone, and these bricks changed. Returns what the methods are told.
  MirrorChanges end_piece(std::vector<BrickCoord> bricks) {
    MirrorChanges changes;
    changes.bricks = std::move(bricks);
    changes.pieces_removed = {1};
    pieces_.clear();
    stones_.step(pieces_, field_, eye_m_, changes);
    return changes;
  }
  MirrorChanges merge() {
    const StampOperation stamp{1, quantise(pieces_.at(1).pose), 0, StampMethod::facets};
    return end_piece(apply(Operation(stamp), field_, table_).changed);
  }
  /// Whether the stone is still drawn after a blow there.
  bool lies_after_blow_at(glm::vec3 at_m) {
    const Shape ball{ShapeKind::sphere, at_m, glm::vec3(0.0F), 1.0F};
    MirrorChanges changes;
    changes.bricks =
        apply(Operation(CarveOperation{ball, SeedPattern::uniform, 8, 5, at_m, 2}), field_, table_).changed;
    const bool lies = stones_.step(pieces_, field_, eye_m_, changes).contains(1);
    EXPECT_EQ(changes.pieces_removed.empty(), lies) << "methods are told that it ended";
    return lies;
  }

  const glm::vec3 eye_m_{0.0F, 2.0F, 8.0F};
  MapField field_{flat_terrain};
  PieceTable table_;
  ScenePieces pieces_;
  SettledStones stones_;
};

TEST_F(SettledStonesTest, a_merged_piece_stays_as_it_lay_until_rock_goes_from_there) {
  const Pose lay = pieces_.at(1).pose;
  const MirrorChanges changes = merge();
  EXPECT_TRUE(changes.pieces_removed.empty()) << "methods go on drawing it";
  ASSERT_TRUE(stones_.shown().contains(1));
  EXPECT_EQ(stones_.shown().at(1).pose.position_m, lay.position_m);
  EXPECT_TRUE(lies_after_blow_at({9.0F, 0.0F, 0.0F})) << "a blow four metres away";
  EXPECT_FALSE(lies_after_blow_at({5.0F, 0.5F, 0.0F}));
  EXPECT_EQ(stones_.count(), 0U);
}

TEST_F(SettledStonesTest, a_piece_that_breaks_or_is_dug_in_the_air_leaves_none) {
  pieces_[1].pose = quantised_pose({5.0F, 3.0F, 0.0F});
  MirrorChanges none;
  stones_.step(pieces_, field_, eye_m_, none);
  EXPECT_EQ(end_piece({}).pieces_removed, std::vector<PieceId>{1});
  EXPECT_EQ(stones_.count(), 0U);
}

TEST_F(SettledStonesTest, a_refused_prediction_whose_rock_comes_back_leaves_none) {
  pieces_[1].pose = {table_.at(1)->centre_voxels * voxel_m, {1.0F, 0.0F, 0.0F, 0.0F}};
  MirrorChanges none;
  stones_.step(pieces_, field_, eye_m_, none);
  const Shape ball{ShapeKind::sphere, {0.0F, 0.0F, 0.0F}, glm::vec3(0.0F), 1.6F};
  end_piece(apply(Operation(FillOperation{ball, material::rock}), field_, table_).changed);
  EXPECT_EQ(stones_.count(), 0U);
}

TEST_F(SettledStonesTest, a_stone_that_rock_covers_is_not_drawn_until_it_is_dug_out) {
  merge();
  ASSERT_TRUE(stones_.shown().contains(1));
  const Shape over{ShapeKind::box, {5.0F, 1.5F, 0.0F}, glm::vec3(3.0F, 2.0F, 3.0F), 0.0F};
  MirrorChanges filled;
  filled.bricks = apply(Operation(FillOperation{over, material::rock}), field_, table_).changed;
  EXPECT_FALSE(stones_.step(pieces_, field_, eye_m_, filled).contains(1));
  EXPECT_EQ(filled.pieces_removed, std::vector<PieceId>{1});
  EXPECT_EQ(stones_.count(), 1U);
  const Shape lid{ShapeKind::box, {5.0F, 1.7F, 0.0F}, glm::vec3(2.0F, 1.0F, 2.0F), 0.0F};
  MirrorChanges dug;
  dug.bricks = apply(Operation(DigOperation{lid}), field_, table_).changed;
  EXPECT_TRUE(stones_.step(pieces_, field_, eye_m_, dug).contains(1));
  EXPECT_EQ(dug.pieces_added, std::vector<PieceId>{1});
}

/// What a server tells of the piece that merged.
class ToldStonesTest : public SettledStonesTest {
 protected:
  void SetUp() override {
    SettledStonesTest::SetUp();
    told_ = {1, table_.at(1), quantise(pieces_.at(1).pose), 0};
    apply(Operation(StampOperation{1, told_.pose, 0, StampMethod::facets}), field_, table_);
    const StonePoints points = stone_points(*told_.volume, dequantise(told_.pose), voxel_m);
    told_.lies = points_in_rock(points, field_);
    ASSERT_NE(told_.lies, 0U);
  }
  MirrorChanges tell(const SettledStone& stone) {
    MirrorChanges changes;
    changes.stones = {stone};
    late_.step({}, field_, eye_m_, changes);
    return changes;
  }

  SettledStone told_;
  SettledStones late_;
};

TEST_F(ToldStonesTest, a_stone_that_the_server_tells_of_lies_until_rock_goes_from_there) {
  const MirrorChanges changes = tell(told_);
  EXPECT_EQ(changes.pieces_added, std::vector<PieceId>{1});
  ASSERT_TRUE(late_.shown().contains(1));
  EXPECT_EQ(late_.shown().at(1).volume, told_.volume);
  EXPECT_EQ(late_.shown().at(1).pose.position_m, dequantise(told_.pose).position_m);
  EXPECT_TRUE(tell(told_).pieces_added.empty()) << "told a second time";
  MirrorChanges dug;
  const Shape ball{ShapeKind::sphere, {5.0F, 0.5F, 0.0F}, glm::vec3(0.0F), 1.0F};
  dug.bricks =
      apply(Operation(CarveOperation{ball, SeedPattern::uniform, 8, 5, {}, 2}), field_, table_).changed;
  EXPECT_TRUE(late_.step({}, field_, eye_m_, dug).empty());
  EXPECT_EQ(dug.pieces_removed, std::vector<PieceId>{1});
}

TEST_F(ToldStonesTest, a_stone_that_does_not_lie_in_rock_is_not_shown) {
  SettledStone in_the_air = told_;
  in_the_air.pose.y += 5 * 1024;
  EXPECT_TRUE(tell(in_the_air).pieces_added.empty());
  SettledStone of_no_point = told_;
  of_no_point.lies = 0x80000000U;
  EXPECT_TRUE(tell(of_no_point).pieces_added.empty());
  EXPECT_EQ(late_.count(), 0U);
}

TEST_F(ToldStonesTest, a_stone_whose_piece_is_there_is_not_shown) {
  MirrorChanges changes;
  changes.stones = {told_};
  late_.step(pieces_, field_, eye_m_, changes);
  EXPECT_TRUE(changes.pieces_added.empty());
  EXPECT_EQ(late_.count(), 0U);
}

TEST_F(ToldStonesTest, stones_are_bounded_and_the_farthest_end_first) {
  MirrorChanges changes;
  for (PieceId id = 10; id <= 10 + limits::settled_stones_max; ++id) {
    changes.stones.push_back(told_);
    changes.stones.back().id = id;
  }
  changes.stones[3].pose.x -= 1024 / 4;
  late_.step({}, field_, {9.0F, 0.3F, 0.0F}, changes);
  EXPECT_EQ(late_.count(), limits::settled_stones_max);
  EXPECT_FALSE(late_.shown().contains(13)) << "it lies a quarter of a metre farther";
}

TEST_F(SettledStonesTest, another_world_has_none) {
  merge();
  stones_.forget();
  MirrorChanges none;
  EXPECT_TRUE(stones_.step(pieces_, field_, eye_m_, none).empty());
}

}  // namespace
}  // namespace scree
