// Each kind of joint against its law.
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/prop/limits.h"
#include "tests/support/flat_world.h"
#include "tests/support/joined_props.h"

namespace scree {
namespace {

constexpr int a_second = 60;
constexpr float half_circle = 3.14159265F;

float turned_rad(const Pose& pose) {
  return 2.0F * std::acos(std::min(1.0F, std::abs(pose.rotation.w)));
}

TEST(JointMotion, a_hinge_swings_as_a_pendulum) {
  JointWorld world(rock_world());
  constexpr float arm_m = 2.0F, half_m = 0.25F, lean_rad = 0.2F;
  const PieceId post = world.add_post({0.0F, 10.0F, 0.0F});
  const glm::vec3 start_m{arm_m * std::sin(lean_rad), 10.0F - arm_m * std::cos(lean_rad), 0.0F};
  const PieceId id = world.add(crate(half_m, 100.0F), start_m);
  world.join_still(
      joint_at(JointKind::hinge, world.frame(post), world.frame(id), {0.0F, 10.0F, 0.0F}, {0, 0, 1}), id);
  float before_m = world.place_m(id).x, amplitude_m = 0.0F;
  std::vector<float> crossings;
  for (int tick = 1; tick <= 20 * a_second; ++tick) {
    world.step();
    const glm::vec3 at_m = world.place_m(id);
    EXPECT_NEAR(glm::distance(at_m, {0.0F, 10.0F, 0.0F}), arm_m, 0.02F * arm_m);
    EXPECT_LT(std::abs(at_m.z), 0.01F);
    if (before_m > 0.0F && at_m.x <= 0.0F)
      crossings.push_back((static_cast<float>(tick) - at_m.x / (at_m.x - before_m)) / a_second);
    if (tick > 15 * a_second) amplitude_m = std::max(amplitude_m, at_m.x);
    before_m = at_m.x;
  }
  ASSERT_GE(crossings.size(), 4U);
  const float inertia = arm_m * arm_m + 2.0F / 3.0F * half_m * half_m;
  const float period_s =
      2.0F * half_circle * std::sqrt(inertia / (9.81F * arm_m)) * (1.0F + lean_rad * lean_rad / 16.0F);
  EXPECT_NEAR((crossings.back() - crossings.front()) / static_cast<float>(crossings.size() - 1), period_s,
              0.02F * period_s);
  EXPECT_GT(amplitude_m, 0.8F * start_m.x);
  EXPECT_LT(amplitude_m, 1.05F * start_m.x);
}

TEST(JointMotion, a_slider_slides_along_its_axis_alone_and_to_its_limit) {
  JointWorld world(rock_world());
  const PieceId post = world.add_post({0.0F, 10.0F, 0.0F}), id = world.add(crate(0.3F), {0.0F, 10.0F, 0.0F});
  const glm::vec3 axis = glm::normalize(glm::vec3(1.0F, -1.0F, 0.5F)), origin_m = world.place_m(id);
  Joint joint = joint_at(JointKind::slider, world.frame(post), world.frame(id), origin_m, axis);
  joint.limits = JointLimits{-1.0F, 3.0F};
  world.join(joint);
  for (int tick = 0; tick < 4 * a_second; ++tick) {
    world.step();
    const glm::vec3 off_m = world.place_m(id) - origin_m;
    EXPECT_LT(glm::length(off_m - axis * glm::dot(off_m, axis)), 0.02F);
    EXPECT_LT(glm::dot(off_m, axis), 3.1F);
    EXPECT_LT(turned_rad(world.pose(id)), 0.03F);
  }
  EXPECT_NEAR(glm::dot(world.place_m(id) - origin_m, axis), 3.0F, 0.02F);
}

TEST(JointMotion, a_motor_lifts_a_slider_at_its_speed_and_not_more_than_it_can_bear) {
  for (const float force_n : {3000.0F, 1000.0F}) {  // the crate weighs 1,962 N
    JointWorld world(rock_world());
    const PieceId post = world.add_post({0.0F, 10.0F, 0.0F}), id = world.add(crate(0.3F), {0.0F, 5.0F, 0.0F});
    Joint joint = joint_at(JointKind::slider, world.frame(post), world.frame(id), world.place_m(id),
                           {0.0F, 1.0F, 0.0F});
    joint.limits = JointLimits{-1.0F, 2.0F};
    joint.motor = {0.5F, force_n};
    world.join(joint);
    world.steps(a_second);
    const float from_m = world.place_m(id).y;
    world.steps(a_second);
    EXPECT_NEAR(world.place_m(id).y - from_m, force_n > 2000.0F ? 0.5F : 0.0F, 0.02F);
    world.steps(5 * a_second);
    EXPECT_NEAR(world.place_m(id).y, force_n > 2000.0F ? 7.0F : 4.0F, 0.05F);
  }
}

TEST(JointMotion, a_hinge_reaches_its_motors_speed_as_its_torque_allows_and_stays_awake) {
  JointWorld world(rock_world());
  const PieceId post = world.add_post({0.0F, 10.0F, 0.0F});
  Prop wheel = prop_of({.kind = PropPartKind::cylinder, .half_m = {0.5F, 0.1F, 0.0F}}, 80.0F);
  const PieceId id = world.add(wheel, {0.0F, 10.0F, 0.0F});
  Joint joint =
      joint_at(JointKind::hinge, world.frame(post), world.frame(id), {0.0F, 10.0F, 0.0F}, {0, 1, 0});
  joint.motor = {8.0F, 20.0F};
  const JointId hinge = world.join(joint);
  world.steps(a_second - 1);
  EXPECT_NEAR(world.motion(id).spin_rad_s.y, 2.0F, 0.05F) << "20 N m on 10 kg m²";
  world.steps(5 * a_second);
  EXPECT_NEAR(world.motion(id).spin_rad_s.y, 8.0F, 0.05F);
  EXPECT_EQ(world.ask(SetMotorRequest{hinge, {-0.1F, 500.0F}}).refusal, "");
  world.steps(10 * a_second);
  EXPECT_NEAR(world.motion(id).spin_rad_s.y, -0.1F, 0.005F) << "it would sleep without its motor";
}

TEST(JointMotion, limits_hold_a_hinge_against_its_motor) {
  JointWorld world(rock_world());
  const PieceId post = world.add_post({0.0F, 10.0F, 0.0F}), id = world.add(crate(0.3F), {1.0F, 10.0F, 0.0F});
  Joint joint =
      joint_at(JointKind::hinge, world.frame(post), world.frame(id), {0.0F, 10.0F, 0.0F}, {0, 1, 0});
  joint.limits = JointLimits{-0.5F, 1.2F};
  joint.motor = {3.0F, 5000.0F};
  const JointId hinge = world.join(joint);
  for (int tick = 0; tick < 3 * a_second; ++tick) {
    world.step();
    EXPECT_LT(turned_rad(world.pose(id)), 1.25F);
  }
  EXPECT_NEAR(turned_rad(world.pose(id)), 1.2F, 0.02F);
  world.ask(SetMotorRequest{hinge, {-3.0F, 5000.0F}});
  world.steps(3 * a_second);
  EXPECT_NEAR(turned_rad(world.pose(id)), 0.5F, 0.02F);
}

TEST(JointMotion, a_rope_of_five_metres_holds_two_tonnes_and_breaks_at_three) {
  for (const float mass_kg : {2000.0F, 3000.0F}) {
    JointWorld world(rock_world());
    const PieceId post = world.add_post({0.0F, 20.0F, 0.0F}),
                  id = world.add(crate(0.5F, mass_kg), {0.0F, 15.0F, 0.0F});
    Joint rope = line_between(JointKind::rope, world.frame(post), {0.0F, 20.0F, 0.0F}, world.frame(id),
                              world.place_m(id));
    rope.break_force_n = 25000.0F;
    const JointId joint = world.join_still(rope, id);
    std::optional<JointEnd> end = world.end(joint);
    for (int tick = 0; tick < 5 * a_second && !end; ++tick) {
      world.step();
      end = world.end(joint);
    }
    EXPECT_EQ(end, mass_kg < 2500.0F ? std::nullopt : std::optional(JointEnd::broken));
    if (!end) {
      EXPECT_NEAR(world.place_m(id).y, 15.0F, 0.03F);
    }
    world.steps(3 * a_second);
    if (end) {
      EXPECT_NEAR(world.place_m(id).y, 0.5F, 0.1F);
    }
  }
}

TEST(JointMotion, a_slack_rope_lets_fall_until_it_is_taut) {
  JointWorld world(rock_world());
  const PieceId post = world.add_post({0.0F, 20.0F, 0.0F}), id = world.add(crate(), {0.0F, 18.0F, 0.0F});
  Joint rope = line_between(JointKind::rope, world.frame(post), {0.0F, 20.0F, 0.0F}, world.frame(id),
                            world.place_m(id));
  rope.length_m = 5.0F;
  world.join(rope);
  float lowest_m = 20.0F;
  for (int tick = 0; tick < 5 * a_second; ++tick) {
    world.step();
    lowest_m = std::min(lowest_m, world.place_m(id).y);
  }
  EXPECT_GT(lowest_m, 14.8F);
  EXPECT_NEAR(world.place_m(id).y, 15.0F, 0.05F);
}

TEST(JointMotion, a_distance_keeps_two_that_whirl_apart) {
  JointWorld world(rock_world());
  Prop prop = crate(0.3F);
  prop.gravity = 0.0F;
  const PieceId a = world.add(prop, {-1.0F, 10.0F, 0.0F}), b = world.add(prop, {1.0F, 10.0F, 0.0F});
  world.join(
      line_between(JointKind::distance, world.frame(a), world.place_m(a), world.frame(b), world.place_m(b)));
  world.ask(MovePropRequest{a, {}, {}, glm::vec3(0.0F, 0.0F, 4.0F)});
  world.ask(MovePropRequest{b, {}, {}, glm::vec3(0.0F, 1.0F, -4.0F)});
  for (int tick = 0; tick < 10 * a_second; ++tick) {
    world.step();
    EXPECT_NEAR(glm::distance(world.place_m(a), world.place_m(b)), 2.0F, 0.04F);
  }
}

TEST(JointMotion, a_fixed_joint_makes_one_body_of_two) {
  JointWorld world(rock_world());
  const PieceId a = world.add(crate(0.4F), {0.0F, 5.0F, 0.0F}),
                b = world.add(crate(0.4F), {0.9F, 5.2F, 0.0F});
  world.join(JointKind::fixed, a, b, {0.45F, 5.1F, 0.0F});
  world.ask(PushRequest{a, {100.0F, 0.0F, 300.0F}, world.place_m(a)});
  for (int tick = 0; tick < 4 * a_second; ++tick) {
    world.step();
    const Pose at_a = world.pose(a), at_b = world.pose(b);
    const glm::vec3 off_m = glm::conjugate(at_a.rotation) * (at_b.position_m - at_a.position_m);
    EXPECT_LT(glm::distance(off_m, glm::vec3(0.9F, 0.2F, 0.0F)), 0.08F);
  }
}

TEST(JointMotion, ten_links_of_a_chain_hang_still) {
  JointWorld world(rock_world());
  const std::vector<PieceId> chain = hang_chain(world, {0.0F, 12.0F, 0.0F}, 10);
  const glm::vec3 end_m{0.0F, 12.0F - 9.5F * 0.5F, 0.0F};
  world.steps(5 * a_second);
  for (int tick = 0; tick < 5 * a_second; ++tick) {
    world.step();
    EXPECT_LT(glm::distance(world.place_m(chain.back()), end_m), 0.05F);
  }
  EXPECT_LT(world.speed_m_s(chain.back()), 0.01F);
}

TEST(JointMotion, a_chain_bears_a_load_of_twenty_links) {
  JointWorld world(rock_world());
  std::vector<PieceId> chain = hang_chain(world, {0.0F, 12.0F, 0.0F}, 10);
  const PieceId load = world.add(crate(0.3F, 100.0F), {0.0F, 6.65F, 0.0F});
  world.join(JointKind::ball, chain.back(), load, {0.0F, 7.0F, 0.0F});
  world.steps(10 * a_second);
  EXPECT_NEAR(world.place_m(load).y, 6.65F, 0.03F);
  EXPECT_LT(world.speed_m_s(load), 0.01F);
}

/// Eight crates in a ring, in the air.
std::vector<PieceId> add_ring(JointWorld& world) {
  std::vector<PieceId> ring;
  for (int i = 0; i < 8; ++i) {
    const float angle = 0.25F * half_circle * static_cast<float>(i);
    ring.push_back(world.add(crate(0.3F, 50.0F), {3.0F * std::cos(angle), 5.0F, 3.0F * std::sin(angle)}));
  }
  return ring;
}

TEST(JointMotion, a_ring_of_joints_that_is_nearly_a_metre_too_narrow_comes_to_rest) {
  JointWorld world(rock_world());
  const std::vector<PieceId> ring = add_ring(world);
  for (size_t i = 0; i < ring.size(); ++i) {
    Joint joint = line_between(JointKind::distance, world.frame(ring[i]), world.place_m(ring[i]),
                               world.frame(ring[(i + 1) % 8]), world.place_m(ring[(i + 1) % 8]));
    if (i == 3) joint.length_m -= 0.95F * limits::joint_gap_max_m;
    world.join(joint);
  }
  world.steps(10 * a_second);
  for (const PieceId id : ring) EXPECT_LT(world.speed_m_s(id), 0.2F);
}

TEST(JointMotion, a_ring_of_joints_that_can_never_fit_does_not_explode) {
  JointWorld world(rock_world());
  const std::vector<PieceId> ring = add_ring(world);
  for (size_t i = 0; i < ring.size(); ++i) {
    const PieceId a = ring[i], b = ring[(i + 1) % ring.size()];
    Joint joint = joint_at(i % 2 == 0 ? JointKind::hinge : JointKind::fixed, world.frame(a), world.frame(b),
                           0.5F * (world.place_m(a) + world.place_m(b)));
    joint.b.place_m += glm::vec3(-0.6F, 0.4F, 0.6F);
    joint.b.turn = {0.6F, 0.0F, 0.8F, 0.0F};
    world.join(joint);
  }
  for (int tick = 0; tick < 10 * a_second; ++tick) {
    world.step();
    for (const PieceId id : ring) ASSERT_LT(world.speed_m_s(id), 50.0F) << tick;
  }
}

TEST(JointMotion, jointed_bodies_touch_only_if_they_may) {
  for (const bool touches : {false, true}) {
    JointWorld world(rock_world());
    const PieceId low = world.add(crate(), {0.0F, 0.5F, 0.0F}), high = world.add(crate(), {0.0F, 1.5F, 0.0F});
    world.steps(a_second);
    Joint rope = line_between(JointKind::rope, world.frame(low), world.place_m(low), world.frame(high),
                              world.place_m(high));
    rope.length_m = 3.0F;
    rope.touches = touches;
    const JointId joint = world.join(rope);
    world.steps(2 * a_second);
    EXPECT_NEAR(world.place_m(high).y, touches ? 1.5F : 0.5F, 0.1F);
    EXPECT_EQ(world.ask(RemoveJointRequest{joint}).refusal, "");
    world.steps(2 * a_second);
    EXPECT_GT(glm::distance(world.place_m(high), world.place_m(low)), 0.9F) << "they meet again";
  }
}

TEST(JointMotion, a_body_that_is_put_elsewhere_keeps_its_joints) {
  JointWorld world(rock_world());
  const PieceId post = world.add_post({0.0F, 10.0F, 0.0F}), id = world.add(crate(0.3F), {0.0F, 8.0F, 0.0F});
  world.join(line_between(JointKind::rope, world.frame(post), {0.0F, 10.0F, 0.0F}, world.frame(id),
                          world.place_m(id)));
  world.steps(a_second);
  EXPECT_EQ(world.ask(MovePropRequest{id, glm::vec3(1.0F, 9.0F, 0.0F)}).refusal, "");
  world.steps(20 * a_second);
  EXPECT_LT(glm::distance(world.place_m(id), glm::vec3(0.0F, 10.0F, 0.0F)), 2.05F);
  EXPECT_GT(world.place_m(id).y, 7.9F);
}

}  // namespace
}  // namespace scree
