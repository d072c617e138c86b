// What fits into no tick comes as soon as ticks with time to spare have paid for it, and by the rules of
// older recordings as seldom as ever.
#include <gtest/gtest.h>

#include "server/world/spawn.h"
#include "tests/support/flat_world.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

constexpr uint64_t builder = 1;
constexpr int boxes = 20;

struct Fallen {
  Tick after = 0;                           ///< ticks until the last box fell
  uint32_t estimate_us = 0, budget_us = 0;  ///< sums, from the first fall to the last
};

/// A client that is alone fills boxes of 14 m in the air, a box in ten ticks.
Fallen fall_of_boxes(uint32_t rules) {
  WorldConfig config = flat_world();
  config.rules = rules;
  World world(config);
  Fallen fallen;
  int fell = 0;
  for (Tick tick = 0; tick < 1500 && fell < boxes; ++tick) {
    std::vector<Command> commands;
    if (tick % 10 == 0 && tick / 10 < boxes) {
      const float x = 200.0F + 20.0F * static_cast<float>(tick / 10);
      commands.push_back({builder, 1, FillRequest{box({x, 200.0F, 0.0F}, glm::vec3(7.0F))}});
    }
    const auto delta = step(world, commands);
    EXPECT_EQ(delta->ledger.error(), 0);
    for (const AppliedOperation& applied : delta->operations)
      fell += std::holds_alternative<IslandOperation>(applied.operation) ? 1 : 0;
    fallen.after = tick;
    if (fell == 0) continue;
    fallen.estimate_us += delta->work.estimate_us;
    fallen.budget_us += delta->work.budget_us;
  }
  EXPECT_EQ(fell, boxes);
  return fallen;
}

TEST(spare_time, dear_islands_of_one_client_fall_soon_where_nobody_else_asks_for_anything) {
  const Fallen before = fall_of_boxes(rules::by_party), now = fall_of_boxes(rules::spare_time);
  EXPECT_LT(now.after, 240U);
  EXPECT_GT(before.after, now.after + 30);
  EXPECT_LE(now.estimate_us, now.budget_us) << "what is done is paid for";
}

}  // namespace
}  // namespace scree
