// A world's limit of memory: edits beyond are refused by name, merges go on, and a higher limit lifts it.
#include <gtest/gtest.h>

#include "bench/support/scenes.h"
#include "server/work/limits.h"
#include "server/world/limits.h"
#include "server/world/settings.h"
#include "server/world/world.h"

namespace scree {
namespace {

TEST(memory_max, edits_beyond_are_refused_by_name_until_it_is_raised) {
  WorldConfig config;
  config.terrain = {TerrainKind::flat, 1, 0.25F};
  config.memory_max_mb = limits::memory_max_min_mb;
  World world(config);
  // Paint of 8 m edits at most 9³ bricks and costs no pieces.
  const auto paint = [&](int at) {
    const float x_m = 40.0F * static_cast<float>(at % 40) - 800.0F, z_m = 40.0F * static_cast<float>(at / 40);
    return Command{1, static_cast<uint32_t>(at),
                   PaintRequest{box({x_m, 0.0F, z_m}, glm::vec3(4.6F)), Material::ice}};
  };
  int done = 0;
  std::optional<Reply> refused;
  std::shared_ptr<const TickDelta> delta;
  for (int at = 0; at < 4000 && !refused; ++at) {
    delta = world.step({{paint(at)}});
    for (int wait = 0; delta->replies.empty() && wait < 60; ++wait) delta = world.step({});
    ASSERT_EQ(delta->replies.size(), 1U);
    if (delta->replies[0].refusal.empty())
      ++done;
    else
      refused = delta->replies[0];
    ASSERT_LE(delta->work.memory_mb, config.memory_max_mb);
  }
  ASSERT_TRUE(refused.has_value());
  EXPECT_GT(done, 50);
  EXPECT_EQ(refused->reason, Refusal::memory_max);
  EXPECT_NE(refused->refusal.find("--memory-max"), std::string::npos) << refused->refusal;
  // Where terrain is edited already there is room; and everywhere, once the limit is raised.
  delta = world.step({{paint(0)}});
  ASSERT_EQ(delta->replies.size(), 1U);
  EXPECT_EQ(delta->replies[0].refusal, "");
  delta = world.step({{{0, 1, SettingsRequest{{{"memory-max", "1024"}}}}, paint(3999)}});
  for (int wait = 0; delta->replies.size() < 2 && wait < 60 && delta->replies.empty(); ++wait)
    delta = world.step({});
  for (const Reply& reply : delta->replies) EXPECT_EQ(reply.refusal, "");
}

}  // namespace
}  // namespace scree
