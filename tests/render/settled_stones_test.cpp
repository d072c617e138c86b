#include "client/render/scene/settled_stones.h"

#include <gtest/gtest.h>

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

TEST_F(SettledStonesTest, another_world_has_none) {
  merge();
  stones_.forget();
  MirrorChanges none;
  EXPECT_TRUE(stones_.step(pieces_, field_, eye_m_, none).empty());
}

}  // namespace
}  // namespace scree
