// What holds terrain up on ground by heights: rock down to the floor, at whatever height the surface lies.
#include <gtest/gtest.h>

#include "server/world/world.h"
#include "shared/falling/ground.h"
#include "tests/support/memory_heights.h"

namespace scree {
namespace {

/// A tower of 7 m and 30 m high, on level ground.
TerrainSource tower() {
  const auto height = [](int x, int z) {
    return std::abs(x - 20) < 4 && std::abs(z - 20) < 4 ? 30 * 256 : 0;
  };
  return {TerrainKind::flat, 1, 0.25F, std::make_shared<MemoryHeights>(41, 41, 1.0F, height)};
}

size_t islands_after(const Shape& cut) {
  WorldConfig config;
  config.terrain = tower();
  World world(config);
  const Command blow{.body = CarveRequest{.shape = cut}};
  auto delta = world.step({&blow, 1});
  EXPECT_TRUE(delta->replies.front().refusal.empty()) << delta->replies.front().refusal;
  size_t islands = 0;
  for (int tick = 0; tick < 60; ++tick) {
    for (const AppliedOperation& applied : delta->operations)
      islands += std::holds_alternative<IslandOperation>(applied.operation) ? 1 : 0;
    delta = world.step({});
  }
  EXPECT_EQ(world.step({})->ledger.error(), 0);
  return islands;
}

TEST(HeightsIslands, a_tower_that_is_cut_through_falls_and_one_that_is_nicked_stands) {
  EXPECT_GE(islands_after(box({0.0F, 26.0F, 0.0F}, {5.0F, 1.0F, 5.0F})), 1U);
  EXPECT_EQ(islands_after(box({4.0F, 26.0F, 0.0F}, {3.0F, 1.0F, 5.0F})), 0U);
}

TEST(HeightsIslands, a_column_of_rock_is_ground_as_long_as_nothing_in_it_was_edited) {
  const auto plateau =
      std::make_shared<MemoryHeights>(200, 200, 1.0F, [](int x, int) { return x < 60 ? 0 : 50 * 256; });
  MapField field({TerrainKind::flat, 1, 0.25F, plateau});
  const BrickCoord inside{10, 20, 0};  // x 20 m, y 40 m
  EXPECT_TRUE(Ground(field).holds(inside));
  EXPECT_FALSE(Ground(field).holds({10, 30, 0})) << "above the surface";
  EXPECT_FALSE(Ground(field).holds({-30, 20, 0})) << "where the surface is lower";
  field.set_brick({10, 6, 0}, air_brick());
  EXPECT_FALSE(Ground(field).holds(inside)) << "something was edited below";
  EXPECT_TRUE(Ground(field).holds({10, 2, 0})) << "but not below here";
}

}  // namespace
}  // namespace scree
