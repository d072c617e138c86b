// Rigid bodies on the field: they fall, rest, stay out of the rock, wake, and do so the same every time.
#include "server/bodies/bodies.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>

#include "server/bodies/limits.h"
#include "shared/base/random.h"
#include "shared/field/paint.h"
#include "shared/operation/operation.h"
#include "tests/support/bodies_support.h"
#include "tests/support/materials.h"
#include "tests/support/tilted_ground.h"

namespace scree {
namespace {

/// The same body in a volume's axes that `turn` turns into the given shape's.
BodyShape turned(BodyShape shape, glm::quat turn) {
  const glm::mat3 matrix = glm::mat3_cast(turn);
  for (glm::vec3& corner : shape.hull_m) corner = matrix * corner;
  const glm::mat3 tensor = matrix * shape.inertia_kg_m2 * glm::transpose(matrix);
  shape.inertia_kg_m2 = 0.5F * (tensor + glm::transpose(tensor));
  return shape;
}

float speed_of(const BodyState& state) {
  return std::sqrt(glm::dot(state.velocity_m_s, state.velocity_m_s));
}

/// Boxes of all sizes thrown about over a patch of ground.
void rain_boxes(Bodies& bodies, const TerrainSource& source, PieceId count) {
  Random random(42);
  for (PieceId id = 1; id <= count; ++id) {
    const float x = random.unit() * 12.0F, z = random.unit() * 12.0F;
    const float y = ground_height_m(source, x, z) + 1.5F + random.unit() * 8.0F;
    const glm::vec3 half = 0.12F + 0.4F * glm::vec3(random.unit(), random.unit(), random.unit());
    const glm::vec3 velocity = 20.0F * (glm::vec3(random.unit(), random.unit(), random.unit()) - 0.5F);
    BodyState state = body_at(id, {x, y, z}, velocity);
    state.spin_rad_s = 10.0F * (glm::vec3(random.unit(), random.unit(), random.unit()) - 0.5F);
    bodies.add(box_shape(half), state);
  }
}

// In one of the runs a step sends the small one 3 m off: farther than its bounds were foreseen to reach.
TEST(Bodies, near_finds_what_a_blow_just_sent_off) {
  for (int run = 0; run < 16; ++run) {
    MapField field(ground(TerrainKind::flat));
    Bodies bodies(field, {});
    bodies.add(box_shape(glm::vec3(0.3F)), body_at(1, {0.0F, 400.0F, 0.0F}));
    const float from_m = -4.0F - 0.2F * static_cast<float>(run);
    bodies.add(box_shape(glm::vec3(1.5F)), body_at(2, {from_m, 400.0F, 0.0F}, {190.0F, 0.0F, 0.0F}));
    for (int tick = 0; tick < 6; ++tick) {
      step(bodies, 1);
      for (const PieceId id : {1U, 2U}) {
        const glm::vec3 at = bodies.state(id).pose.position_m;
        EXPECT_EQ(std::ranges::count(bodies.near(at - 0.1F, at + 0.1F), id), 1) << id << " at " << at.x;
      }
    }
  }
}

TEST(Bodies, falls_and_rests_on_flat_ground) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(1, {0.1F, 4.0F, 0.1F}));
  step(bodies, 30);
  EXPECT_NEAR(bodies.state(1).pose.position_m.y, 4.0F - 0.5F * 9.81F * 0.25F, 0.1F);
  EXPECT_TRUE(bodies.contacts().on_terrain.empty());
  step(bodies, 150);
  const BodyState rest = bodies.state(1);
  EXPECT_NEAR(rest.pose.position_m.y, 0.5F, 0.02F);
  EXPECT_LT(speed_of(rest), 0.02F);
  EXPECT_EQ(bodies.contacts().on_terrain, std::vector<PieceId>{1});
}

TEST(Bodies, the_axes_in_which_a_body_is_described_make_no_difference) {
  MapField field(ground(TerrainKind::flat));
  const glm::quat lean = glm::angleAxis(0.5F, glm::normalize(glm::vec3(0.2F, 0.1F, 1.0F)));
  const glm::quat turn = glm::angleAxis(0.8F, glm::normalize(glm::vec3(1.0F, 2.0F, 3.0F)));
  const BodyShape rod = box_shape({1.0F, 0.15F, 0.25F});
  BodyState state = body_at(1, {0.0F, 2.0F, 0.0F});
  state.pose.rotation = lean;
  state.spin_rad_s = {1.0F, 0.5F, 0.0F};
  Bodies along(field, {}), across(field, {});
  along.add(rod, state);
  state.pose.rotation = lean * glm::conjugate(turn);
  across.add(turned(rod, turn), state);
  EXPECT_NEAR(std::abs(glm::dot(across.state(1).pose.rotation, state.pose.rotation)), 1.0F, 1e-6F);
  // Until its end has struck; what it does after its second blow depends on the last bits.
  for (int tick = 0; tick < 60 && along.contacts().on_terrain.empty(); ++tick) {
    along.step();
    across.step();
  }
  ASSERT_FALSE(along.contacts().on_terrain.empty()) << "its end has struck the ground";
  const BodyState a = along.state(1), b = across.state(1);
  EXPECT_LT(glm::distance(a.pose.position_m, b.pose.position_m), 1e-4F);
  EXPECT_GT(std::abs(glm::dot(a.pose.rotation, b.pose.rotation * turn)), 0.99999F);
  EXPECT_LT(glm::distance(a.spin_rad_s, b.spin_rad_s), 0.01F);
}

TEST(Bodies, a_stack_says_who_carries_whom) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  for (PieceId id = 1; id <= 3; ++id)
    bodies.add(box_shape(glm::vec3(0.5F)), body_at(id, {0.0F, 1.1F * static_cast<float>(id), 0.0F}));
  step(bodies, 180);
  EXPECT_NEAR(bodies.state(3).pose.position_m.y, 2.5F, 0.05F);
  const BodyContacts contacts = bodies.contacts();
  EXPECT_EQ(contacts.on_terrain, std::vector<PieceId>{1});
  EXPECT_EQ(contacts.carried, (std::vector<Carried>{{2, 1}, {3, 2}}));
}

/// How far a box slides that sets out at 4 m/s over ground of the material.
float slide_m(Material material) {
  MapField field(ground(TerrainKind::flat));
  paint_bricks(field, in_voxels(sphere({0.0F, 0.0F, 0.0F}, 12.0F), voxel_m), material);
  Bodies bodies(field, {});
  bodies.add(box_shape({0.6F, 0.2F, 0.6F}), body_at(1, {-4.0F, 0.21F, 0.1F}, {4.0F, 0.0F, 0.0F}));
  step(bodies, 240);
  return bodies.state(1).pose.position_m.x + 4.0F;
}

TEST(Bodies, points_of_all_bodies_are_counted_and_large_ones_have_more) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, BodiesConfig{});
  bodies.add(box_shape(glm::vec3(0.2F)), body_at(1, {0.0F, 5.0F, 0.0F}));
  const size_t small = bodies.ground_points();
  EXPECT_GE(small, 8U);
  bodies.add(box_shape(glm::vec3(1.5F)), body_at(2, {8.0F, 5.0F, 0.0F}));
  EXPECT_GT(bodies.ground_points(), 3 * small);
  bodies.remove(2);
  EXPECT_EQ(bodies.ground_points(), small);
}

TEST(Bodies, hulls_that_overlap_are_counted_and_those_that_touch_are_not) {
  MapField field(ground(TerrainKind::flat));
  const auto overlaps = [&](float apart_m) {
    Bodies bodies(field, BodiesConfig{});
    bodies.add(box_shape(glm::vec3(0.5F)), body_at(1, {0.0F, 5.0F, 0.0F}));
    bodies.add(box_shape(glm::vec3(0.5F)), body_at(2, {apart_m, 5.0F, 0.0F}));
    EXPECT_EQ(bodies.overlaps(), 0U);
    bodies.step();
    return bodies.overlaps();
  };
  EXPECT_EQ(overlaps(0.1F), 1U);
  EXPECT_EQ(overlaps(8.0F), 0U);
}

TEST(Bodies, the_material_of_the_ground_holds_them_back) {
  const float on_soil = slide_m(material::soil), on_rock = slide_m(material::rock);
  EXPECT_GT(on_soil, 0.1F);
  EXPECT_GT(on_rock, 1.1F * on_soil);
  EXPECT_GT(slide_m(material::ice), 1.3F * on_rock);
}

TEST(Bodies, none_of_two_hundred_falls_through_noise_terrain) {
  MapField field(ground(TerrainKind::noise));
  Bodies bodies(field, {});
  rain_boxes(bodies, field.source(), 200);
  float deepest_voxels = 0.0F;
  for (int tick = 0; tick < 480; ++tick) {
    bodies.step();
    for (const BodyState& state : bodies.states())
      deepest_voxels =
          std::min(deepest_voxels, sample(field, state.pose.position_m / voxel_m).distance_voxels);
  }
  EXPECT_GT(deepest_voxels, -0.5F) << "a centre of mass is in the rock";
  double sum = 0.0;
  for (const BodyState& state : bodies.states()) sum += speed_of(state);
  EXPECT_LT(sum / 200.0, 0.1) << "the heap does not settle";
}

TEST(Bodies, a_speck_at_top_speed_does_not_pass_the_ground) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  for (PieceId id = 1; id <= 20; ++id)
    bodies.add(box_shape(glm::vec3(0.1F)),
               body_at(id, {static_cast<float>(id), 3.0F + 0.037F * static_cast<float>(id), 0.0F},
                       {0.0F, -500.0F, 0.0F}));
  for (int tick = 0; tick < 120; ++tick) {
    bodies.step();
    for (const BodyState& state : bodies.states()) ASSERT_GT(state.pose.position_m.y, 0.0F);
  }
}

TEST(Bodies, speed_and_spin_are_cut_to_what_a_tick_can_carry) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  BodyState mad = body_at(1, {0.0F, 50.0F, 0.0F}, {1000.0F, 0.0F, 0.0F});
  mad.spin_rad_s = {0.0F, 1000.0F, 0.0F};
  constexpr float half_m = 0.5F;
  bodies.add(box_shape(glm::vec3(half_m)), mad);
  for (int tick = 0; tick < 10; ++tick) {
    const BodyState before = bodies.state(1);
    EXPECT_LE(glm::length(before.spin_rad_s), limits::spin_max_rad_s * 1.001F);
    EXPECT_LE(speed_of(before), limits::speed_max_m_s * 1.001F);
    EXPECT_LE(glm::length(before.spin_rad_s) * bodies.reach_m(1) / 60.0F,
              0.2F * limits::travel_max_voxels * voxel_m * 1.001F);
    bodies.step();
  }
}

TEST(Bodies, a_spike_does_not_pass_through_a_big_face) {
  MapField field(ground(TerrainKind::flat));
  PieceTable pieces;
  apply(FillOperation{capsule({0.0F, -1.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.4F)}, field, pieces);
  Bodies bodies(field, {});
  bodies.add(box_shape({4.0F, 0.5F, 4.0F}), body_at(1, {0.0F, 3.0F, 0.0F}));
  step(bodies, 45);
  EXPECT_GT(bodies.state(1).pose.position_m.y, 1.5F) << "the plate fell past the spike's top at 1.4 m";
}

TEST(Bodies, buried_bodies_are_pushed_out) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  bodies.add(box_shape(glm::vec3(0.3F)), body_at(1, {0.0F, -2.0F, 0.0F}));
  step(bodies, 240);
  EXPECT_GT(bodies.state(1).pose.position_m.y, 0.0F);
}

TEST(Bodies, a_sleeping_body_wakes_when_the_ground_is_taken_away) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(1, {0.0F, 0.6F, 0.0F}));
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(2, {20.0F, 0.6F, 0.0F}));
  step(bodies, 400);
  ASSERT_EQ(bodies.awake(), 0U);
  dig(field, {0.0F, 0.0F, 0.0F}, 3.0F, bodies);
  bodies.step();
  EXPECT_EQ(bodies.awake(), 1U);
  step(bodies, 120);
  EXPECT_LT(bodies.state(1).pose.position_m.y, -1.5F);
  EXPECT_NEAR(bodies.state(2).pose.position_m.y, 0.5F, 0.02F);
}

TEST(Bodies, a_sleeping_body_wakes_when_what_carries_it_is_removed) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(1, {0.0F, 0.5F, 0.0F}));
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(2, {0.0F, 1.5F, 0.0F}));
  step(bodies, 400);
  ASSERT_EQ(bodies.awake(), 0U);
  bodies.remove(1);
  EXPECT_FALSE(bodies.contains(1));
  EXPECT_EQ(bodies.size(), 1U);
  step(bodies, 60);
  EXPECT_NEAR(bodies.state(2).pose.position_m.y, 0.5F, 0.05F);
}

TEST(Bodies, two_worlds_with_the_same_calls_agree_bit_for_bit) {
  MapField field_a(ground(TerrainKind::noise)), field_b(ground(TerrainKind::noise));
  Bodies a(field_a, {}), b(field_b, {});
  rain_boxes(a, field_a.source(), 100);
  rain_boxes(b, field_b.source(), 100);
  const glm::vec3 hole(6.0F, ground_height_m(field_a.source(), 6.0F, 6.0F), 6.0F);
  for (int tick = 1; tick <= 300; ++tick) {
    a.step();
    b.step();
    if (tick == 90) dig(field_a, hole, 2.0F, a), dig(field_b, hole, 2.0F, b);
    if (tick % 50 == 0) a.remove(static_cast<PieceId>(tick / 10)), b.remove(static_cast<PieceId>(tick / 10));
    ASSERT_EQ(a.state_hash(), b.state_hash()) << "at tick " << tick;
  }
}

TEST(Bodies, what_is_no_number_is_stopped_where_it_was) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(1, {0.0F, 5.0F, 0.0F}, {nan, 0.0F, 0.0F}));
  step(bodies, 200);
  EXPECT_NEAR(bodies.state(1).pose.position_m.y, 0.5F, 0.05F);
}

TEST(Frozen, stands_still_and_carries_like_the_ground) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(1, {0.0F, 0.5F, 0.0F}));
  step(bodies, 60);
  bodies.freeze(1);
  const glm::vec3 stood = bodies.state(1).pose.position_m;
  bodies.add(box_shape(glm::vec3(0.3F)), body_at(2, {0.1F, 1.5F, 0.0F}));
  step(bodies, 120);
  EXPECT_EQ(bodies.state(1).pose.position_m, stood);
  EXPECT_TRUE(bodies.state(1).frozen);
  EXPECT_NEAR(bodies.state(2).pose.position_m.y, 1.3F, 0.03F);
  EXPECT_EQ(bodies.contacts().on_terrain, std::vector<PieceId>{2});
  EXPECT_TRUE(bodies.contacts().carried.empty());
  EXPECT_EQ(bodies.frozen(), 1U);
  EXPECT_GT(bodies.mass_kg(1), 0.0F);
}

TEST(Frozen, a_heap_thaws_from_the_ground_up_when_it_is_undermined) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  for (PieceId id = 1; id <= 4; ++id)
    bodies.add(box_shape(glm::vec3(0.5F)), body_at(id, {0.0F, 1.02F * static_cast<float>(id) - 0.5F, 0.0F}));
  step(bodies, 120);
  for (PieceId id = 1; id <= 4; ++id) bodies.freeze(id);
  step(bodies, 60);
  EXPECT_EQ(bodies.awake(), 0U);
  dig(field, {0.0F, -0.6F, 0.0F}, 1.0F, bodies);
  bodies.step();
  EXPECT_GT(bodies.frozen(), 0U) << "the upper ones are far from the ground";
  EXPECT_LT(bodies.frozen(), 4U);
  step(bodies, 120);
  EXPECT_EQ(bodies.frozen(), 0U);
  for (PieceId id = 1; id <= 4; ++id)
    EXPECT_LT(bodies.state(id).pose.position_m.y, 1.0F * static_cast<float>(id) - 0.7F) << "piece " << id;
}

TEST(Frozen, a_hard_blow_thaws_and_its_momentum_is_kept) {
  MapField field(ground(TerrainKind::flat));
  BodiesConfig config;
  config.gravity_m_s2 = 0.0F;
  Bodies bodies(field, config);
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(1, {0.0F, 20.0F, 0.0F}));
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(2, {3.0F, 20.0F, 0.0F}, {-8.0F, 0.0F, 0.0F}));
  bodies.freeze(1);
  step(bodies, 40);
  EXPECT_FALSE(bodies.state(1).frozen);
  const float sum = bodies.state(1).velocity_m_s.x + bodies.state(2).velocity_m_s.x;
  EXPECT_LT(bodies.state(1).velocity_m_s.x, -1.0F);
  EXPECT_NEAR(sum, -8.0F, 0.5F) << "less what the air took";
}

TEST(Frozen, removing_what_it_touches_thaws_it_and_a_light_touch_does_not) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(1, {0.0F, 0.5F, 0.0F}));
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(2, {0.0F, 1.52F, 0.0F}));
  step(bodies, 90);
  bodies.freeze(1);
  bodies.freeze(2);
  bodies.add(box_shape(glm::vec3(0.2F)), body_at(3, {0.0F, 2.35F, 0.0F}));
  step(bodies, 60);
  EXPECT_EQ(bodies.frozen(), 2U);
  bodies.remove(1);
  bodies.step();
  EXPECT_FALSE(bodies.state(2).frozen);
  step(bodies, 60);
  EXPECT_NEAR(bodies.state(2).pose.position_m.y, 0.5F, 0.03F);
  bodies.freeze(2);
  bodies.thaw_all();
  EXPECT_EQ(bodies.frozen(), 0U);
}

/// A gate, 4 m wide with an opening of 2 m by 2 m: two posts and a beam, its centre of mass at the origin.
BodyShape gate(bool of_parts) {
  const auto block = [](glm::vec3 middle, glm::vec3 half) {
    std::vector<glm::vec3> corners = box_shape(half).hull_m;
    for (glm::vec3& p : corners) p += middle;
    return corners;
  };
  BodyShape shape = box_shape({2.0F, 1.5F, 0.5F});
  const std::vector<std::vector<glm::vec3>> parts = {block({-1.5F, -0.5F, 0.0F}, {0.5F, 1.0F, 0.5F}),
                                                     block({1.5F, -0.5F, 0.0F}, {0.5F, 1.0F, 0.5F}),
                                                     block({0.0F, 1.0F, 0.0F}, {2.0F, 0.5F, 0.5F})};
  for (const auto& part : parts) shape.surface_m.insert(shape.surface_m.end(), part.begin(), part.end());
  if (of_parts) shape.parts_m = parts;
  return shape;
}

TEST(Compound, a_gate_comes_down_about_what_stands_in_its_opening) {
  for (const bool of_parts : {true, false}) {
    MapField field(ground(TerrainKind::flat));
    Bodies bodies(field, {});
    bodies.add(box_shape(glm::vec3(0.6F)), body_at(1, {0.0F, 0.6F, 0.0F}));
    bodies.add(gate(of_parts), body_at(2, {0.0F, 3.0F, 0.0F}));
    step(bodies, 90);
    const float height_m = bodies.state(2).pose.position_m.y;
    if (of_parts)
      EXPECT_NEAR(height_m, 1.5F, 0.05F);
    else
      EXPECT_GT(height_m, 2.0F) << "as one hull it has no opening";
    EXPECT_NEAR(bodies.state(1).pose.position_m.x, 0.0F, 0.05F);
  }
}

TEST(Compound, its_parts_bear_what_falls_on_them) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  bodies.add(gate(true), body_at(1, {0.0F, 1.5F, 0.0F}));
  bodies.add(box_shape(glm::vec3(0.3F)), body_at(2, {0.0F, 3.5F, 0.0F}));
  step(bodies, 120);
  EXPECT_NEAR(bodies.state(2).pose.position_m.y, 3.3F, 0.06F);
  EXPECT_EQ(bodies.contacts().carried.size(), 1U);
}

}  // namespace
}  // namespace scree
