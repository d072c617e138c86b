// Persons on foot in a world: they walk by their inputs alone, and nothing else moves them.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "server/world/person_limits.h"
#include "shared/person/solid_ground.h"
#include "shared/person/walker.h"
#include "tests/support/person_world.h"

namespace scree {
namespace {

constexpr WalkInput ahead{.go = {1.0F, 0.0F, 0.0F}};

TEST(Persons, walk_by_their_inputs_and_stand_still_without) {
  PersonWorld world;
  const PieceId body = world.stand(1, {0.0F, 0.1F, 0.0F});
  ASSERT_NE(body, 0U);
  EXPECT_EQ(world.person(1).body, body);
  world.walk(1, {}, 60);
  const glm::vec3 begun_m = world.feet_m(1);
  EXPECT_TRUE(world.person(1).walker.stands);
  world.walk(1, ahead, 60);
  EXPECT_EQ(world.person(1).taken, world.number());
  EXPECT_NEAR(world.feet_m(1).x - begun_m.x, 4.0F, 0.3F);
  world.walk(1, {}, 30);
  const glm::vec3 halted_m = world.feet_m(1);
  world.steps(120);
  EXPECT_LT(glm::distance(world.feet_m(1), halted_m), 1e-3F);
  // The body is where the walker is, as all others see it.
  const glm::vec3 middle_m = world.feet_m(1) + glm::vec3(0.0F, 0.5F * Walker::height_m, 0.0F);
  EXPECT_LT(glm::distance(world.place_m(body), middle_m), 2e-3F);
}

TEST(Persons, walk_as_a_client_foresees_it_bit_for_bit) {
  PersonWorld world;
  world.ask(FillRequest{sphere({6.0F, -0.5F, 0.0F}, 1.5F)});
  world.stand(1, {0.0F, 0.3F, 0.4F});
  world.walk(1, {}, 30);
  Walker foreseen(world.person(1).walker);
  for (int tick = 0; tick < 240; ++tick) {
    const WalkInput input{{1.0F, 0.0F, tick % 50 < 25 ? 0.2F : -0.2F}, tick > 120, tick % 40 == 0};
    SolidGround ground(world.world().field(), foreseen.feet_m());
    foreseen.step(input, 1.0F / 60.0F, ground);
    world.walk(1, input, 1);
    ASSERT_EQ(world.person(1).walker, foreseen.state()) << "tick " << tick;
  }
  EXPECT_GT(world.feet_m(1).x, 8.0F);
}

TEST(Persons, take_held_back_inputs_one_for_each_tick_that_has_passed) {
  PersonWorld world;
  world.stand(1, {0.0F, 0.1F, 0.0F});
  world.walk(1, {}, 30);
  uint32_t number = world.number();
  world.steps(10);
  std::vector<Command> commands;
  for (int i = 0; i < 10; ++i) commands.push_back({1, ++number, WalkRequest{ahead}});
  world.step(commands);
  EXPECT_EQ(world.person(1).taken, number) << "ten ticks have passed: ten inputs are carried out";
  // Who sends more than there are ticks is no faster.
  const float begun_m = world.feet_m(1).x;
  for (int tick = 0; tick < 60; ++tick) {
    commands.clear();
    for (int i = 0; i < 3; ++i) commands.push_back({1, ++number, WalkRequest{ahead}});
    world.step(commands);
  }
  EXPECT_LT(world.feet_m(1).x - begun_m, 4.0F * 1.02F + 12.0F * 4.0F / 60.0F + 0.1F);
}

TEST(Persons, are_moved_by_no_lie) {
  PersonWorld world;
  const PieceId body = world.stand(1, {0.0F, 0.1F, 0.0F});
  world.walk(1, {}, 30);
  const glm::vec3 before_m = world.feet_m(1);
  const uint32_t next = world.number() + 1;
  const auto refused = [&](const Request& request, uint32_t number) {
    return refusal_name(world.ask_as(1, request, number));
  };
  EXPECT_EQ(refused(WalkRequest{{.go = {50.0F, 0.0F, 0.0F}}}, next), "walk_invalid") << "teleports";
  EXPECT_EQ(refused(WalkRequest{ahead, {0.0F, 0.0F, 7.0F}}, next), "walk_invalid");
  EXPECT_EQ(refused(WalkRequest{ahead}, next - 1), "walk_invalid") << "of the past";
  EXPECT_EQ(refused(WalkRequest{ahead}, next + limits::walk_numbers_ahead_max), "walk_invalid")
      << "of the future";
  EXPECT_EQ(refused(WalkRequest{ahead}, 0), "walk_invalid");
  EXPECT_EQ(refused(StandRequest{}, 1), "walk_invalid") << "begins anew elsewhere";
  EXPECT_EQ(refused(RemovePropRequest{body}, 1), "person_body");
  EXPECT_EQ(refused(MovePropRequest{.prop = body, .place_m = glm::vec3(9.0F)}, 1), "person_body");
  EXPECT_EQ(refused(PushRequest{body, {1e4F, 0.0F, 0.0F}, before_m}, 1), "person_body");
  const PieceId crate_id = world.add(crate(), {5.0F, 1.0F, 0.0F});
  AddJointRequest join;
  join.joint.kind = JointKind::ball;
  join.joint.a.body = body;
  join.joint.b.body = crate_id;
  EXPECT_EQ(refused(join, 1), "person_body");
  EXPECT_EQ(refusal_name(world.ask_as(2, WalkRequest{ahead})), "not_on_foot") << "another one's person";
  world.steps(30);
  EXPECT_LT(glm::distance(world.feet_m(1), before_m), 1e-3F);
}

TEST(Persons, have_so_many_inputs_waiting_and_no_more) {
  PersonWorld world;
  world.stand(1, {0.0F, 0.1F, 0.0F});
  std::vector<Command> commands;
  for (uint32_t number = 1; number <= 200; ++number) commands.push_back({1, number, WalkRequest{ahead}});
  world.step(commands);
  ASSERT_EQ(world.last().replies.size(), 200U - limits::walk_inputs_max);
  for (const Reply& reply : world.last().replies) EXPECT_EQ(refusal_name(reply), "inputs_waiting");
  world.steps(60);
  EXPECT_EQ(world.person(1).taken, limits::walk_inputs_max);
}

TEST(Persons, leave_with_their_session) {
  PersonWorld world;
  const PieceId body = world.stand(1, {0.0F, 0.1F, 0.0F});
  EXPECT_TRUE(world.has(body));
  world.step({{1, 0, LeaveRequest{}}});
  EXPECT_FALSE(world.has(body));
  EXPECT_FALSE(world.is_on_foot(1));
  world.stand(2, {0.0F, 0.1F, 0.0F});
  EXPECT_EQ(refusal_name(world.ask_as(2, StandRequest{.away = true})), "");
  EXPECT_FALSE(world.is_on_foot(2));
  EXPECT_EQ(refusal_name(world.ask_as(2, StandRequest{.away = true})), "not_on_foot");
}

TEST(Persons, stand_where_visitors_begin) {
  WorldConfig config = walking_world();
  config.spawn = Spawn{{3.0F, 4.0F, -2.0F}};
  PersonWorld world(config);
  EXPECT_EQ(world.ask_as(1, StandRequest{}).refusal, "");
  EXPECT_FLOAT_EQ(world.feet_m(1).x, 3.0F);
  world.steps(180);
  EXPECT_TRUE(world.person(1).walker.stands) << "falls to the ground without an input";
  EXPECT_NEAR(world.feet_m(1).y, 0.0F, 0.3F);
}

TEST(Persons, fly_unless_the_setting_lets_them_walk) {
  PersonWorld world(rock_world());
  EXPECT_EQ(refusal_name(world.ask_as(1, StandRequest{})), "persons_fly");
  world.ask(SettingsRequest{{{"persons", "walk"}}});
  const PieceId body = world.stand(1, {0.0F, 0.1F, 0.0F});
  world.ask(SettingsRequest{{{"persons", "fly"}}});
  EXPECT_FALSE(world.is_on_foot(1));
  EXPECT_FALSE(world.has(body));
}

TEST(Persons, are_props_among_the_props_that_a_server_allows) {
  WorldConfig config = walking_world();
  config.props_max = 1;
  PersonWorld world(config);
  world.stand(1, {0.0F, 0.1F, 0.0F});
  EXPECT_EQ(refusal_name(world.ask_as(2, StandRequest{glm::vec3(0.0F)})), "props_max");
}

TEST(Sight, refuses_what_terrain_hides_from_the_eye) {
  PersonWorld world;
  world.ask(FillRequest{box({4.0F, 2.0F, 0.0F}, {0.5F, 2.5F, 4.0F})});
  CarveRequest carve{.shape = sphere({10.0F, 0.0F, 0.0F}, 1.0F), .seeds = 4, .impact_m = {10.0F, 1.0F, 0.0F}};
  Command hidden{1, 1, carve};
  hidden.eye_m = glm::vec3(0.0F, 1.6F, 0.0F);
  world.step({hidden});
  ASSERT_EQ(world.last().replies.size(), 1U);
  EXPECT_EQ(refusal_name(world.last().replies[0]), "out_of_sight");
  EXPECT_NE(world.last().replies[0].refusal.find("3."), std::string::npos) << world.last().replies[0].refusal;
  Command seen{1, 2, carve};
  seen.eye_m = glm::vec3(7.0F, 1.6F, 0.0F);
  world.step({seen});
  ASSERT_EQ(world.last().replies.size(), 1U);
  EXPECT_EQ(world.last().replies[0].refusal, "");
}

TEST(PersonDigs, who_stands_on_ground_that_is_taken_away_falls) {
  // The deeper the middle, the less the field above the hole tells of it.
  for (const float y_m : {-0.5F, -1.0F, -1.2F}) {
    PersonWorld world;
    world.stand(7, {0.0F, 0.5F, 0.0F});
    world.steps(60);
    ASSERT_NEAR(world.feet_m(7).y, 0.0F, 0.02F);
    DigRequest dig{sphere({0.0F, y_m, 0.0F}, 1.5F)};
    dig.store = worlds_store();
    ASSERT_EQ(world.ask(dig).refusal, "");
    world.steps(90);
    EXPECT_NEAR(world.feet_m(7).y, y_m - 1.5F, 0.3F) << y_m;
    EXPECT_TRUE(world.person(7).walker.stands) << y_m;
    // A wall of the hole stops who walks against it.
    world.walk(7, {{1.0F, 0.0F, 0.0F}}, 60);
    EXPECT_LT(world.feet_m(7).x, 1.4F) << y_m;
    EXPECT_LT(world.feet_m(7).y, -0.3F) << y_m;
  }
}

}  // namespace
}  // namespace scree
