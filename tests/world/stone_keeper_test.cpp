// Stones where pieces merged, as a server keeps them: what begins and ends them, and their bounds.
#include "server/world/stone_keeper.h"

#include <gtest/gtest.h>

#include "server/formats/world_codec.h"
#include "server/world/limits.h"
#include "tests/support/flat_world.h"
#include "tests/support/tick_source.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

/// A piece of flat ground that lies five metres beside its hole.
class StoneKeeperTest : public testing::Test {
 protected:
  void SetUp() override {
    follow({source.carve({0.0F, 0.0F, 0.0F}, 1.5F, 1)});
    source.move(1, {5.0F, 1.0F, 0.0F});
  }
  TickDelta follow(const std::vector<Operation>& operations) {
    TickDelta delta = *source.step(operations);
    keeper.follow(source.field(), delta);
    return delta;
  }
  SettledStone stone(PieceId id) const {
    return {id, volume, quantise(Pose{.position_m = {50.0F, -3.0F, 0.0F}}), 7};
  }
  size_t kept_of(const std::vector<SettledStone>& stones, PieceId next_piece) {
    keeper.restart(source.pieces(), stones, next_piece, source.field());
    return keeper.value().size();
  }

  TickSource source{flat_terrain};
  StoneKeeper keeper;
  std::shared_ptr<const Volume> volume = std::make_shared<const Volume>([] {
    Volume cube;
    cube.window = Window(VoxelBox{{0, 0, 0}, {4, 4, 4}});
    std::ranges::fill(cube.window.codes, Code{-127});
    cube.centre_voxels = {1.5F, 1.5F, 1.5F};
    return cube;
  }());
};

TEST_F(StoneKeeperTest, a_merged_piece_is_a_stone_until_rock_goes_from_there) {
  const auto whole = source.pieces().at(1);
  const StampOperation stamp = source.stamp(1);
  const TickDelta merged = follow({stamp});
  ASSERT_EQ(merged.stones.size(), 1U);
  EXPECT_EQ(merged.stones[0].stone.id, 1U);
  EXPECT_EQ(merged.stones[0].stone.volume, whole);
  EXPECT_EQ(merged.stones[0].stone.pose, stamp.pose);
  EXPECT_TRUE(source.field().has_edits(merged.stones[0].chunk));
  EXPECT_TRUE(follow({source.carve({9.0F, 0.0F, 0.0F}, 1.0F, 1)}).stones_gone.empty()) << "four metres away";
  EXPECT_EQ(keeper.value().size(), 1U);
  const TickDelta dug = follow({source.carve({5.0F, 0.5F, 0.0F}, 1.0F, 1)});
  ASSERT_EQ(dug.stones_gone.size(), 1U);
  EXPECT_EQ(dug.stones_gone[0].stone.id, 1U);
  EXPECT_EQ(dug.stones_gone[0].chunk, merged.stones[0].chunk);
  EXPECT_TRUE(keeper.value().empty());
}

TEST_F(StoneKeeperTest, it_goes_on_from_what_was_kept) {
  follow({source.stamp(1)});
  const std::vector<SettledStone> kept = keeper.value();
  StoneKeeper next;
  next.restart(source.pieces(), kept, 100, source.field());
  ASSERT_EQ(next.value().size(), 1U);
  EXPECT_EQ(next.value()[0].lies, kept[0].lies);
  TickDelta dug = *source.step({source.carve({5.0F, 0.5F, 0.0F}, 1.0F, 1)});
  next.follow(source.field(), dug);
  EXPECT_EQ(dug.stones_gone.size(), 1U) << "by the same rule";
}

TEST_F(StoneKeeperTest, a_piece_that_merges_where_it_was_cut_leaves_none) {
  source.move(1, {-5.0F, -1.0F, 0.0F});
  EXPECT_TRUE(follow({source.stamp(1)}).stones.empty());
}

TEST_F(StoneKeeperTest, stones_that_no_such_world_has_are_left_out) {
  EXPECT_EQ(kept_of({stone(2), stone(3)}, 4), 2U);
  EXPECT_EQ(kept_of({stone(2), stone(3)}, 3), 1U) << "an id that no piece had";
  EXPECT_EQ(kept_of({stone(2), stone(2)}, 4), 1U) << "twice";
  EXPECT_EQ(kept_of({stone(1)}, 4), 0U) << "a piece that is alive";
  SettledStone nowhere = stone(2);
  nowhere.lies = 0x80000000U;
  EXPECT_EQ(kept_of({nowhere}, 4), 0U) << "a point that it does not have";
}

TEST_F(StoneKeeperTest, stones_are_bounded_in_number_and_the_oldest_go_first) {
  std::vector<SettledStone> many;
  constexpr PieceId first = 10;
  for (PieceId id = first; id < first + limits::kept_stones_max; ++id) many.push_back(stone(id));
  EXPECT_EQ(kept_of(many, 100000), limits::kept_stones_max);
  TickDelta delta = *source.step({source.stamp(1)});
  keeper.follow(source.field(), delta);
  EXPECT_TRUE(delta.stones.empty()) << "piece 1 is older than all";
  many.push_back(stone(first + limits::kept_stones_max));
  EXPECT_EQ(kept_of(many, 100000), limits::kept_stones_max);
  EXPECT_EQ(keeper.value().front().id, first + 1);
}

TEST_F(StoneKeeperTest, stones_are_bounded_in_bytes) {
  Volume large = *volume;
  large.window = Window(VoxelBox{{0, 0, 0}, {128, 128, 128}});
  std::ranges::fill(large.window.codes, Code{-127});
  volume = std::make_shared<const Volume>(large);
  std::vector<SettledStone> many;
  for (PieceId id = 10; id < 50; ++id) many.push_back(stone(id));
  EXPECT_EQ(kept_of(many, 100), limits::kept_stone_bytes_max / (size_t{128} * 128 * 128) - 1);
  EXPECT_EQ(keeper.value().back().id, 49U);
}

TEST(StonesOfAWorld, are_in_its_moment_and_go_on_after_a_restart_but_are_no_part_of_its_value) {
  World world(rock_world());
  CarveRequest carve;
  carve.shape = sphere({0.0F, 0.0F, 0.0F}, 1.5F);
  carve.seeds = 24;
  carve.random_seed = 3;
  carve.impact_m = {0.0F, 1.0F, 0.0F};
  step(world, {{1, 1, carve}});
  size_t settled = 0;
  for (int tick = 0; tick < settle_ticks_max && !world.moment().pieces.empty(); ++tick)
    settled += step(world)->stones.size();
  const WorldSnapshot value = world.snapshot();
  ASSERT_GE(value.moment.stones.size(), 5U);
  EXPECT_GE(settled, value.moment.stones.size());
  EXPECT_EQ(world.keyframe().stones.size(), value.moment.stones.size());
  const auto restored = World::restore(value);
  ASSERT_TRUE(restored.has_value()) << restored.error().message;
  ASSERT_EQ((*restored)->moment().stones.size(), value.moment.stones.size());
  WorldSnapshot without = value;
  without.moment.stones.clear();
  EXPECT_EQ(encode(without), encode(value)) << "worlds are compared by these bytes";
  const auto bare = World::restore(without);
  ASSERT_TRUE(bare.has_value());
  for (int tick = 0; tick < 30; ++tick) EXPECT_EQ(step(**bare)->state_hash, step(**restored)->state_hash);
}

}  // namespace
}  // namespace scree
