// Joints of light bodies under great loads: nothing gains energy, and what hangs is still.
#include <glm/geometric.hpp>

#include "tests/support/flat_world.h"
#include "tests/support/joined_props.h"

namespace scree {
namespace {

constexpr int second_ticks = 60;

TEST(JointLoad, forty_links_of_five_kilos_hold_a_tonne_still) {
  JointWorld world(rock_world());
  std::vector<PieceId> chain = hang_chain(world, {0.0F, 30.0F, 0.0F}, 40);
  const PieceId load = world.add(crate(0.4F, 1000.0F), {0.0F, 9.5F, 0.0F});
  world.join(JointKind::ball, chain.back(), load, {0.0F, 10.0F, 0.0F});
  world.steps(10 * second_ticks);
  for (int tick = 0; tick < 5 * second_ticks; ++tick) {
    world.step();
    for (const PieceId id : chain) ASSERT_LT(world.speed_m_s(id), 0.1F) << tick;
  }
  EXPECT_NEAR(world.place_m(load).y, 9.5F, 0.1F);
}

TEST(JointLoad, a_link_of_five_kilos_holds_fifty_tonnes) {
  JointWorld world(rock_world());
  std::vector<PieceId> chain = hang_chain(world, {0.0F, 20.0F, 0.0F}, 1);
  const PieceId load = world.add(crate(0.4F, 50'000.0F), {0.0F, 19.0F, 0.0F});
  world.join(JointKind::ball, chain.back(), load, {0.0F, 19.5F, 0.0F});
  world.steps(10 * second_ticks);
  EXPECT_LT(world.speed_m_s(load), 0.01F);
  EXPECT_LT(world.speed_m_s(chain.back()), 0.01F);
  EXPECT_NEAR(world.place_m(load).y, 19.0F, 0.2F);
}

/// Planks of 50 kg with hinges from post to post, 20 m above the ground, all joined and at rest.
void add_bridge(JointWorld& world, int planks) {
  const auto place_m = [&](int i) { return glm::vec3(static_cast<float>(i) - 0.5F, 20.0F, 0.0F); };
  const Prop plank = prop_of({.kind = PropPartKind::box, .half_m = {0.48F, 0.05F, 1.0F}}, 50.0F);
  std::vector<PieceId> bridge{world.add_post(place_m(0)), world.add_post(place_m(planks + 1))};
  for (int i = 1; i <= planks; ++i) bridge.insert(bridge.end() - 1, world.add(plank, place_m(i)));
  std::vector<Command> commands;
  uint32_t request = 0;
  for (int i = 0; i <= planks; ++i) {
    const PieceId a = bridge[static_cast<size_t>(i)], b = bridge[static_cast<size_t>(i) + 1];
    const glm::vec3 hinge_m(static_cast<float>(i), 20.0F, 0.0F);
    commands.push_back({0, ++request,
                        MovePropRequest{b, place_m(i + 1), glm::quat(1.0F, 0.0F, 0.0F, 0.0F), glm::vec3(0.0F),
                                        glm::vec3(0.0F)}});
    commands.push_back({0, ++request,
                        AddJointRequest{joint_at(JointKind::hinge, {a, place_m(i)}, {b, place_m(i + 1)},
                                                 hinge_m, {0.0F, 0.0F, 1.0F})}});
  }
  world.step(commands);
}

// Before joints were solved together, it threw its planks at 160 m/s.
TEST(JointLoad, a_bridge_of_planks_bears_two_tonnes) {
  JointWorld world(rock_world());
  add_bridge(world, 20);
  const PieceId load = world.add(crate(0.5F, 2000.0F), {10.0F, 21.0F, 0.0F});
  for (int tick = 0; tick < 20 * second_ticks; ++tick) {
    world.step();
    for (const BodyMotion& one : world.world().moment().motion.bodies)
      ASSERT_LT(glm::length(one.velocity_m_s), 6.0F) << tick;
  }
  EXPECT_LT(world.speed_m_s(load), 0.05F);
  EXPECT_GT(world.place_m(load).y, 19.0F);
}

TEST(JointLoad, a_motor_of_any_torque_turns_a_beam_and_tears_nothing) {
  for (const float torque_nm : {1e5F, 1e8F, 1e11F}) {
    JointWorld world(rock_world());
    const PieceId post = world.add_post({0.0F, 20.0F, 0.0F});
    const PieceId beam = world.add(prop_of({.kind = PropPartKind::box, .half_m = {1.0F, 0.1F, 0.2F}}, 100.0F),
                                   {1.0F, 20.0F, 0.0F});
    Joint hinge = joint_at(JointKind::hinge, world.frame(post), world.frame(beam), {0.0F, 20.0F, 0.0F},
                           {0.0F, 0.0F, 1.0F});
    hinge.motor = {120.0F, torque_nm};
    world.join_still(hinge, beam);
    for (int tick = 0; tick < 5 * second_ticks; ++tick) {
      world.step();
      ASSERT_LT(world.speed_m_s(beam), 40.0F) << torque_nm << " N m, tick " << tick;
      ASSERT_NEAR(glm::distance(world.place_m(beam), glm::vec3(0.0F, 20.0F, 0.0F)), 1.0F, 0.3F) << torque_nm;
    }
  }
}

// It is drawn aside with each step's straight way: without care it swings at 3 m/s for ever.
TEST(JointLoad, a_short_line_holds_a_great_load_still) {
  JointWorld world(rock_world());
  const glm::vec3 post_m{0.0F, 100.0F, 0.0F}, load_m{0.6F, 100.0F, 0.0F};
  const PieceId post = world.add_post(post_m);
  const PieceId load = world.add(crate(0.4F, 1e5F), load_m);
  Joint rope = line_between(JointKind::rope, {post, post_m}, post_m, {load, load_m}, load_m);
  rope.length_m = 0.01F;
  world.join(rope);
  world.steps(20 * second_ticks);
  EXPECT_LT(world.speed_m_s(load), 0.5F);
  EXPECT_LT(glm::distance(world.place_m(load), post_m), 0.1F);
}

// More joints than are solved at once hold a hub. They hold it one by one.
TEST(JointLoad, a_hub_of_sixty_ropes_hangs_still) {
  JointWorld world(rock_world());
  const PieceId post = world.add_post({0.0F, 20.0F, 0.0F});
  const PieceId hub = world.add(crate(0.5F, 500.0F), {0.0F, 16.0F, 0.0F});
  const JointFrame held = world.frame(hub);
  std::vector<Command> commands{{0, 1, MovePropRequest{hub, {}, {}, glm::vec3(0.0F), glm::vec3(0.0F)}}};
  for (uint32_t i = 0; i < 60; ++i) {
    const float x = 0.01F * static_cast<float>(i) - 0.3F;
    commands.push_back({0, i + 2,
                        AddJointRequest{line_between(JointKind::distance, world.frame(post), {x, 19.8F, 0.0F},
                                                     held, held.origin_m + glm::vec3(x, 0.5F, 0.0F))}});
  }
  world.step(commands);
  world.steps(20 * second_ticks);
  EXPECT_LT(world.speed_m_s(hub), 0.1F);
  EXPECT_NEAR(world.place_m(hub).x, 0.0F, 0.3F);
}

}  // namespace
}  // namespace scree
