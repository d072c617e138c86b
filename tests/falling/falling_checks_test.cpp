// Misuse of the searches for falling terrain aborts, in every build.
#include <gtest/gtest.h>

#include "shared/falling/island.h"
#include "shared/falling/island_search.h"
#include "shared/falling/load_flow.h"

namespace scree {
namespace {

TEST(FallingDeathTest, capacities_are_not_negative_and_links_join_two_nodes) {
  LoadFlow flow;
  const uint32_t a = flow.add_node(1), b = flow.add_node(1);
  EXPECT_DEATH(flow.link(a, b, -1, 0), "CHECK failed: forth >= 0");
  EXPECT_DEATH(flow.link(a, a, 1, 1), "CHECK failed: a != b");
  EXPECT_DEATH(flow.link(a, 2, 1, 1), "CHECK failed: a != b");
  EXPECT_DEATH(flow.add_node(-1), "CHECK failed: load >= 0");
}

TEST(FallingDeathTest, nothing_is_overloaded_before_the_flow_ran) {
  LoadFlow flow;
  const uint32_t node = flow.add_node(1);
  EXPECT_DEATH(static_cast<void>(flow.overloaded(node)), "CHECK failed: node < held_.size()");
}

TEST(FallingDeathTest, an_unfinished_search_has_no_islands) {
  MapField field(TerrainSource{TerrainKind::flat});
  field.set_brick({0, 4, 0}, solid_brick());
  const BrickCoord changed{0, 4, 0};
  IslandSearch search(field, {&changed, 1});
  EXPECT_DEATH(static_cast<void>(search.islands()), "CHECK failed: open_.empty()");
  size_t bricks = SIZE_MAX;
  ASSERT_TRUE(search.advance(bricks));
  EXPECT_EQ(search.islands().size(), 1U);
  EXPECT_DEATH(static_cast<void>(search.islands({0, 4})), "CHECK failed: limits.side_bricks > 0");
}

TEST(FallingDeathTest, an_islands_start_lies_in_its_box) {
  const VoxelBox box{{0, 0, 0}, {2, 2, 2}};
  Window window(lift_box(box), code_solid);
  EXPECT_DEATH(lift(window, box, {2, 0, 0}), "CHECK failed");
  Window small(box, code_solid);
  EXPECT_DEATH(lift(small, box, {0, 0, 0}), "CHECK failed");
}

}  // namespace
}  // namespace scree
