// Carves into more pieces than are made at once: their cuts in later ticks end, whatever happens to the
// pieces.
#include <gtest/gtest.h>

#include "server/world/world.h"
#include "tests/support/flat_world.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

CarveRequest ball(float radius_m, uint32_t seeds) {
  CarveRequest carve;
  carve.shape = sphere({0.0F, 0.0F, 0.0F}, radius_m);
  carve.pattern = SeedPattern::radial;
  carve.seeds = seeds;
  return carve;
}

/// Ticks until nothing is alive and nothing waits for its cut; 0 when that does not come within half a
/// minute.
int ticks_to_rest(World& world, const CarveRequest& carve) {
  auto delta = world.step({{{1, 1, carve}}});
  EXPECT_EQ(delta->replies.at(0).refusal, "");
  for (int tick = 1; tick < 1800; ++tick) {
    delta = world.step({});
    EXPECT_EQ(delta->ledger.error(), 0);
    if (delta->pieces.empty() && delta->work.refractures_put_off == 0) return tick;
  }
  return 0;
}

TEST(refracture, more_pieces_than_the_volume_has_room_for_come_to_an_end) {
  for (const auto& [radius_m, seeds] :
       {std::pair(1.0F, 300U), std::pair(1.5F, 1500U), std::pair(3.0F, 2000U)}) {
    World world(flat_world());
    EXPECT_GT(ticks_to_rest(world, ball(radius_m, seeds)), 0) << radius_m << " m";
  }
}

TEST(refracture, what_was_lifted_whole_is_cut_in_the_next_tick_whatever_that_costs) {
  World world(flat_world());
  auto delta = world.step({{{1, 1, ball(8.0F, 2000)}}});
  ASSERT_EQ(delta->pieces.size(), 1U);
  delta = world.step({});
  EXPECT_GT(delta->pieces.size(), 1U);
}

TEST(refracture, pieces_that_froze_while_they_waited_are_cut) {
  WorldConfig config = flat_world();
  config.methods.recombine = Recombination::off;
  World world(config);
  CarveRequest carve = ball(4.0F, 2000);
  carve.blast_speed_m_s = 0.0F;
  auto delta = world.step({{{1, 1, carve}}});
  for (int tick = 0; tick < 1200 && delta->work.refractures_put_off > 0; ++tick) delta = world.step({});
  EXPECT_EQ(delta->work.refractures_put_off, 0U);
  EXPECT_GT(delta->pieces.size(), 200U);
  EXPECT_EQ(delta->ledger.error(), 0);
}

}  // namespace
}  // namespace scree
