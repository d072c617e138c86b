// The scenes that a world gives for questions about space.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shared/base/timing.h"
#include "shared/query/query.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

WorldConfig scene_config() {
  WorldConfig config;
  config.terrain = {TerrainKind::noise, 3, 0.5F};
  return config;
}

TEST(Scene, asking_changes_no_tick) {
  PropWorld asked(scene_config()), silent(scene_config());
  for (PropWorld* world : {&asked, &silent}) world->add(crate(), {0.0F, 60.0F, 0.0F});
  for (int i = 0; i < 60; ++i) {
    CarveRequest carve;
    carve.shape = sphere({static_cast<float>(i % 7), 0.0F, 0.0F}, 2.0F);
    carve.seeds = 4;
    std::vector<Command> commands;
    if (i % 20 == 0) commands.push_back({0, 7, carve});
    const HeldScene scene = asked.world().scene();
    EXPECT_TRUE(cast_ray(scene, {0.0F, 100.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 300.0F).has_value());
    const uint64_t hash = asked.step(commands).state_hash;
    EXPECT_EQ(hash, silent.step(commands).state_hash);
  }
}

TEST(Scene, of_some_two_thousand_bodies_is_made_in_a_part_of_a_tick) {
  WorldConfig config = scene_config();
  config.props_max = 4096;
  PropWorld world(config);
  std::vector<Command> commands;
  Prop shelf = crate(0.4F);
  shelf.motion = PropMotion::fixed;
  shelf.parts.push_back(
      {.kind = PropPartKind::sphere, .place_m = {0.0F, 1.0F, 0.0F}, .half_m = glm::vec3(0.3F)});
  for (int i = 0; i < 2000; ++i) {
    commands.push_back(
        {0, static_cast<uint32_t>(i + 1),
         AddPropRequest{shelf, glm::vec3(2 * (i % 50), 100 + 3 * (i / 1000), 2 * (i / 50 % 20))}});
    if (commands.size() == 100) {
      world.step(commands);
      commands.clear();
    }
  }
  for (int i = 0; i < 200 && world.last().props.size() < 2000; ++i) world.step();
  ASSERT_GT(world.last().props.size(), 1800U);
  double best_s = 1.0;
  for (int i = 0; i < 10; ++i) {
    const double begin_s = steady_now_s();
    const HeldScene scene = world.world().scene();
    best_s = std::min(best_s, steady_now_s() - begin_s);
    EXPECT_EQ(scene.scene().solids().size(), world.last().props.size());
  }
  RecordProperty("microseconds", static_cast<int>(best_s * 1e6));
  fmt::print("a scene of {} bodies is made in {:.0f} us\n", world.last().props.size(), best_s * 1e6);
  EXPECT_LT(best_s, 0.016);
}

}  // namespace
}  // namespace scree
