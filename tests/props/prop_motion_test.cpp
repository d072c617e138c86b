// How props move: they fall, lie still, roll, stack, and push and are pushed.
#include <cmath>
#include <glm/geometric.hpp>

#include "bench/support/scenes.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

constexpr int second = 60;

TEST(PropMotion, each_shape_comes_to_rest_on_the_ground_at_its_own_height) {
  struct Case {
    PropPart part;
    float rests_at_m;
  };
  PropPart hull{.kind = PropPartKind::hull};
  for (int i = 0; i < 8; ++i)
    hull.corners_m.push_back(
        {(i & 1) != 0 ? 0.5F : -0.5F, (i & 2) != 0 ? 0.3F : -0.3F, (i & 4) != 0 ? 0.4F : -0.4F});
  const Case cases[] = {
      {{.kind = PropPartKind::box, .half_m = {0.5F, 0.5F, 0.5F}}, 0.5F},
      {{.kind = PropPartKind::sphere, .half_m = glm::vec3(0.4F)}, 0.4F},
      {{.kind = PropPartKind::cylinder, .half_m = {0.5F, 0.4F, 0.0F}}, 0.4F},
      {{.kind = PropPartKind::capsule,
        .turn = {0.70710678F, 0.0F, 0.0F, 0.70710678F},
        .half_m = {0.3F, 0.5F, 0.0F}},
       0.3F},
      {hull, 0.3F},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(name_of(one.part.kind));
    PropWorld world(rock_world());
    const PieceId id = world.add(prop_of(one.part, 100.0F), {0.0F, 2.0F, 0.0F});
    world.steps(3 * second);
    const glm::vec3 before_m = world.place_m(id);
    world.steps(second / 2);
    EXPECT_LT(glm::distance(world.place_m(id), before_m), 0.01F);
    EXPECT_NEAR(before_m.y, one.rests_at_m, 0.04F);
    EXPECT_NEAR(glm::length(glm::vec2(before_m.x, before_m.z)), 0.0F, 0.1F);
  }
}

TEST(PropMotion, a_crate_falls_when_its_ground_is_blown_away_and_lies_still) {
  PropWorld world(rock_world());
  world.ask(FillRequest{box({0.0F, 2.0F, 0.0F}, {0.75F, 2.0F, 0.75F})});
  const PieceId id = world.add(crate(), {0.0F, 4.5F, 0.0F});
  world.steps(second);
  EXPECT_NEAR(world.place_m(id).y, 4.5F, 0.03F);
  CarveRequest carve;
  carve.shape = box({0.0F, 2.5F, 0.0F}, {1.0F, 1.5F, 1.0F});
  carve.impact_m = {1.5F, 2.5F, 0.0F};
  carve.seeds = 24;
  world.ask(carve);
  world.steps(3 * second);
  EXPECT_LT(world.place_m(id).y, 2.5F);
  const glm::vec3 before_m = world.place_m(id);
  world.steps(second);
  EXPECT_LT(glm::distance(world.place_m(id), before_m), 0.05F);
}

TEST(PropMotion, a_tower_of_ten_crates_stands_for_a_minute) {
  PropWorld world(rock_world());
  std::vector<PieceId> tower;
  for (int i = 0; i < 10; ++i)
    tower.push_back(world.add(crate(), {0.0F, 0.5F + static_cast<float>(i), 0.0F}));
  world.steps(5 * second);
  const glm::vec3 top_m = world.place_m(tower.back());
  world.steps(55 * second);
  for (size_t i = 0; i < tower.size(); ++i) {
    const glm::vec3 at_m = world.place_m(tower[i]);
    EXPECT_NEAR(at_m.y, 0.5F + static_cast<float>(i), 0.05F);
    EXPECT_LT(std::abs(at_m.x) + std::abs(at_m.z), 0.35F);
  }
  EXPECT_LT(glm::distance(world.place_m(tower.back()), top_m), 0.01F) << "it creeps";
}

TEST(PropMotion, a_bullet_passes_no_wall_of_one_voxel) {
  for (const float offset_m : {0.0F, 0.06F, 0.125F, 0.21F}) {
    PropWorld world(rock_world());
    world.ask(FillRequest{box({10.0F + offset_m, 4.0F, 0.0F}, {0.125F, 4.0F, 4.0F})});
    const PieceId id =
        world.add(ball(0.05F, 0.2F), {0.0F, 4.0F + offset_m, 0.3F * offset_m}, {400.0F, 0.0F, 0.0F});
    float farthest_m = 0.0F;
    for (int i = 0; i < second; ++i) {
      world.step();
      if (world.has(id)) farthest_m = std::max(farthest_m, world.place_m(id).x);
    }
    EXPECT_LT(farthest_m, 10.0F + offset_m);
    EXPECT_GT(farthest_m, 9.0F);
  }
}

TEST(PropMotion, a_ball_rolls_down_a_slope_and_a_crate_does_not) {
  // A plank of rock, tilted by ten degrees: a fixed prop.
  PropWorld world(rock_world());
  Prop plank = prop_of({.kind = PropPartKind::box,
                        .turn = {0.99619470F, 0.0F, 0.0F, 0.08715574F},
                        .half_m = {10.0F, 0.25F, 3.0F}},
                       1000.0F);
  plank.motion = PropMotion::fixed;
  world.add(plank, {0.0F, 5.0F, 0.0F});
  const PieceId rolls = world.add(ball(0.4F, 50.0F), {4.0F, 6.5F, -1.0F}),
                stays = world.add(crate(0.4F), {4.0F, 6.4F, 1.0F});
  world.steps(3 * second);
  EXPECT_LT(world.place_m(rolls).x, 1.0F);
  EXPECT_GT(world.place_m(stays).x, 3.6F);
}

/// It lies along z.
Prop roller(PropPartKind kind) {
  return prop_of({.kind = kind, .turn = {0.70710678F, 0.70710678F, 0.0F, 0.0F}, .half_m = {0.3F, 0.6F, 0.0F}},
                 200.0F);
}

TEST(PropMotion, capsules_and_cylinders_lie_still_and_roll_straight) {
  for (const PropPartKind kind : {PropPartKind::capsule, PropPartKind::cylinder})
    for (const float speed_m_s : {0.0F, 3.0F}) {
      SCOPED_TRACE(name_of(kind));
      PropWorld world(rock_world());
      const PieceId id = world.add(roller(kind), {0.0F, 0.32F, 0.0F}, {speed_m_s, 0.0F, 0.0F});
      world.steps(5 * second);
      const glm::vec3 at_m = world.place_m(id);
      EXPECT_NEAR(at_m.y, 0.3F, 0.02F);
      EXPECT_LE(std::abs(at_m.z), 0.05F * at_m.x + 0.01F);
      world.steps(second);
      if (speed_m_s == 0.0F) {
        EXPECT_LT(glm::distance(world.place_m(id), at_m), 0.001F);
      } else {
        EXPECT_GT(at_m.x, 5.0F) << "it does not roll";
      }
    }
}

TEST(PropMotion, capsules_and_cylinders_roll_over_an_edge) {
  for (const PropPartKind kind : {PropPartKind::capsule, PropPartKind::cylinder}) {
    SCOPED_TRACE(name_of(kind));
    PropWorld world(rock_world());
    world.ask(FillRequest{box({-5.0F, 1.0F, 0.0F}, {5.0F, 1.0F, 3.0F})});
    const PieceId id = world.add(roller(kind), {-3.0F, 2.32F, 0.0F}, {3.0F, 0.0F, 0.0F});
    world.steps(6 * second);
    const glm::vec3 at_m = world.place_m(id);
    EXPECT_NEAR(at_m.y, 0.3F, 0.03F);
    EXPECT_GT(at_m.x, 3.0F);
    EXPECT_LT(std::abs(at_m.z), 0.05F * (at_m.x + 3.0F));
    const glm::vec3 axis = world.pose(id).rotation * glm::vec3(0.0F, 0.0F, 1.0F);
    EXPECT_GT(axis.z, 0.99F);
  }
}

TEST(PropMotion, a_kinematic_platform_carries_a_crate) {
  PropWorld world(rock_world());
  Prop platform = prop_of({.kind = PropPartKind::box, .half_m = {2.0F, 0.25F, 2.0F}}, 1000.0F);
  platform.motion = PropMotion::kinematic;
  const PieceId lift = world.add(platform, {0.0F, 1.0F, 0.0F});
  const PieceId load = world.add(crate(), {0.0F, 1.8F, 0.0F});
  world.steps(second);
  EXPECT_EQ(world.ask(MovePropRequest{lift, {}, {}, glm::vec3(0.5F, 1.0F, 0.0F)}).refusal, "");
  world.steps(2 * second);
  EXPECT_NEAR(world.place_m(lift).y, 3.0F, 0.05F);
  EXPECT_NEAR(world.place_m(load).y, 3.75F, 0.1F);
  EXPECT_NEAR(world.place_m(load).x, world.place_m(lift).x, 0.3F);
  EXPECT_EQ(world.ask(MovePropRequest{lift, {}, {}, glm::vec3(0.0F)}).refusal, "");
  const float height_m = world.place_m(lift).y;
  world.steps(second);
  EXPECT_NEAR(world.place_m(lift).y, height_m, 0.01F);
}

TEST(PropMotion, props_meet_by_their_groups) {
  PropWorld world(rock_world());
  Prop ghost = crate();
  ghost.meets = group::terrain;
  Prop lost = crate();
  lost.meets = group::all & ~group::terrain;
  const PieceId a = world.add(crate(), {0.0F, 0.5F, 0.0F}), b = world.add(ghost, {0.2F, 3.0F, 0.0F}),
                c = world.add(lost, {5.0F, 1.0F, 0.0F});
  world.steps(2 * second);
  EXPECT_NEAR(world.place_m(a).y, 0.5F, 0.05F);
  EXPECT_NEAR(world.place_m(b).y, 0.5F, 0.05F) << "it passed through the other";
  EXPECT_LT(world.place_m(c).y, -5.0F) << "it passed through the ground";
}

TEST(PropMotion, gravity_drag_and_pushes_are_the_props_own) {
  PropWorld world(rock_world());
  Prop floats = crate(), slows = crate();
  floats.gravity = 0.0F;
  slows.gravity = 0.0F;
  slows.drag = 0.9F;
  const PieceId a = world.add(floats, {0.0F, 5.0F, 0.0F}), b = world.add(slows, {0.0F, 10.0F, 0.0F});
  for (const PieceId id : {a, b})
    EXPECT_EQ(world.ask(PushRequest{id, glm::vec3(400.0F, 0.0F, 0.0F), world.place_m(id)}).refusal, "");
  world.steps(2 * second);
  EXPECT_NEAR(world.place_m(a).y, 5.0F, 0.01F);
  EXPECT_NEAR(world.place_m(a).x, 4.0F, 0.15F) << "400 N s on 200 kg";
  EXPECT_LT(world.place_m(b).x, 2.2F);
  EXPECT_GT(world.place_m(b).x, 1.0F);
}

TEST(PropMotion, falling_rock_pushes_a_crate_and_a_crate_bears_rock) {
  PropWorld world(rock_world());
  const PieceId id = world.add(crate(0.5F, 100.0F), {3.2F, 0.5F, 0.0F});
  world.steps(second / 2);
  CarveRequest carve = blow_at(world.world().config().terrain, 0.0F, 0.0F, 2.0F, 24, 3);
  carve.blast_speed_m_s = 20.0F;
  world.ask(carve);
  world.steps(4 * second);
  EXPECT_GT(glm::distance(world.place_m(id), glm::vec3(3.2F, 0.5F, 0.0F)), 0.1F);
  EXPECT_TRUE(world.last().pieces.empty() || world.has(id));
}

TEST(PropMotion, rock_that_lies_on_a_fixed_prop_does_not_become_terrain) {
  PropWorld world(rock_world());
  Prop table = prop_of({.kind = PropPartKind::box, .half_m = {3.0F, 0.25F, 3.0F}}, 1000.0F);
  table.motion = PropMotion::fixed;
  world.add(table, {0.0F, 2.0F, 0.0F});
  world.ask(FillRequest{box({0.0F, 5.5F, 0.0F}, {0.75F, 0.75F, 0.75F})});  // hangs in the air, so it falls
  world.steps(6 * second);
  ASSERT_FALSE(world.last().pieces.empty());
  for (const PieceState& piece : world.last().pieces) {
    const glm::vec3 at_m = dequantise(piece.pose).position_m;
    EXPECT_GT(at_m.y, 2.0F);
  }
}

}  // namespace
}  // namespace scree
