// What strikes persons on foot, lies in their way, or closes around them.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "shared/person/solid_ground.h"
#include "shared/person/walker.h"
#include "tests/support/person_world.h"

namespace scree {
namespace {

float depth_m(PersonWorld& world, uint64_t session) {
  SolidGround ground(world.world().field(), world.feet_m(session));
  return Walker::depth_m(world.feet_m(session), ground);
}

TEST(PersonBlows, have_the_energy_of_what_strikes) {
  PersonWorld world;
  const PieceId body = world.stand(1, {0.0F, 0.1F, 0.0F});
  world.walk(1, {}, 30);
  const glm::vec3 middle_m = world.feet_m(1) + glm::vec3(0.0F, 0.9F, 0.0F);
  Prop stone = ball(0.2F, 50.0F);
  stone.gravity = 0.0F;
  world.ask_as(
      7, AddPropRequest{
             stone, middle_m + glm::vec3(-4.0F, 0.0F, 0.0F), {1.0F, 0.0F, 0.0F, 0.0F}, {10.0F, 0.0F, 0.0F}});
  const PieceId thrown = world.last().replies[0].prop.value_or(0);
  world.steps(60);
  const std::vector<Event> hurts = world.told(EventKind::hurt);
  ASSERT_EQ(hurts.size(), 1U);
  RecordProperty("energy_j", std::to_string(hurts[0].energy_j));
  EXPECT_NEAR(hurts[0].energy_j, 0.5F * 50.0F * 100.0F, 250.0F);
  EXPECT_EQ(hurts[0].body, body);
  EXPECT_EQ(hurts[0].other, thrown);
  EXPECT_EQ(hurts[0].tag, 1U) << "whose person it is";
  EXPECT_EQ(hurts[0].session, 7U) << "who threw it";
  std::printf("hurt: %.1f J\n", static_cast<double>(hurts[0].energy_j));
}

TEST(PersonBlows, are_none_where_one_walks_into_what_lies_still) {
  PersonWorld world;
  const PieceId still = world.add(crate(0.5F, 500.0F), {2.0F, 0.5F, 0.0F});
  world.stand(1, {0.0F, 0.1F, 0.0F});
  world.walk(1, {}, 60);
  const glm::vec3 lay_m = world.place_m(still);
  world.walk(1, {.go = {1.0F, 0.0F, 0.0F}, .fast = true}, 90);
  EXPECT_TRUE(world.told(EventKind::hurt).empty());
  EXPECT_LT(world.feet_m(1).x, 1.3F) << "it stops the person";
  EXPECT_LT(glm::distance(world.place_m(still), lay_m), 0.1F) << "and is not shoved on";
}

TEST(PersonBlows, push_who_stands_in_the_way) {
  PersonWorld world;
  Prop wall = crate(0.5F, 500.0F);
  wall.motion = PropMotion::kinematic;
  world.stand(1, {0.0F, 0.1F, 0.0F});
  world.walk(1, {}, 30);
  world.add(wall, {-2.0F, 0.9F, 0.0F}, {1.0F, 0.0F, 0.0F});
  for (int i = 0; i < 180; ++i) world.walk(1, {}, 1);
  EXPECT_GT(world.feet_m(1).x, 0.5F);
}

TEST(PersonBlows, of_terrain_push_out_and_bury_once) {
  PersonWorld world;
  world.stand(1, {0.0F, 0.1F, 0.0F});
  world.walk(1, {}, 30);
  // Rock comes to a side.
  world.ask_as(7, FillRequest{sphere({0.55F, 0.5F, 0.0F}, 0.5F)});
  world.walk(1, {}, 2);
  EXPECT_LE(depth_m(world, 1), Walker::skin_m + 1e-3F);
  EXPECT_TRUE(world.told(EventKind::buried).empty());
  // And closes around.
  world.ask_as(7, FillRequest{sphere(world.feet_m(1) + glm::vec3(0.0F, 0.9F, 0.0F), 3.0F)});
  world.walk(1, {}, 120);
  const std::vector<Event> buried = world.told(EventKind::buried);
  ASSERT_EQ(buried.size(), 1U);
  EXPECT_EQ(buried[0].tag, 1U);
  EXPECT_LE(depth_m(world, 1), Walker::skin_m + 1e-3F) << "rises out of it in the end";
}

/// 200 random walks over broken ground, by two persons.
TEST(PersonWalks, never_enter_rock) {
  PersonWorld world;
  Random random(7);
  for (int i = 0; i < 12; ++i) {
    const glm::vec3 place_m(random.unit() * 20.0F - 10.0F, random.unit() - 0.5F,
                            random.unit() * 20.0F - 10.0F);
    world.ask(FillRequest{box(place_m, glm::vec3(0.5F + random.unit()))});
    CarveRequest carve{.shape = sphere({-place_m.x, 0.0F, place_m.z}, 1.0F + random.unit()), .seeds = 6};
    carve.random_seed = random.next();
    world.ask(carve);
  }
  world.steps(300);
  world.stand(1, {0.0F, 4.0F, 0.0F});
  world.stand(2, {3.0F, 4.0F, 3.0F});
  float worst_m = -1.0F;
  uint32_t number = 0;
  for (int walk = 0; walk < 100; ++walk) {
    const auto way = [&] {
      glm::vec3 go(random.unit() - 0.5F, 0.0F, random.unit() - 0.5F);
      return WalkInput{go / std::max(glm::length(go), 0.1F), random.below(2) == 0, false};
    };
    WalkInput first = way(), second = way();
    // Nobody gets far from the broken ground.
    const auto turn_back = [&](uint64_t session, WalkInput& input) {
      const glm::vec3 feet_m = world.feet_m(session);
      if (glm::length(feet_m) > 12.0F) input.go = -glm::normalize(glm::vec3(feet_m.x, 0.0F, feet_m.z));
    };
    turn_back(1, first);
    turn_back(2, second);
    for (int tick = 0; tick < 90; ++tick) {
      first.jump = second.jump = random.below(40) == 0;
      ++number;
      world.step({{1, number, WalkRequest{first}}, {2, number, WalkRequest{second}}});
      for (const uint64_t session : {1U, 2U}) worst_m = std::max(worst_m, depth_m(world, session));
    }
  }
  std::printf("200 walks: %.4f m deep at most\n", static_cast<double>(worst_m));
  EXPECT_LE(worst_m, Walker::skin_m + 1e-3F);
}

}  // namespace
}  // namespace scree
