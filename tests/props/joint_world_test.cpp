// Joints as part of a world: requests and their refusals, terrain that lets go, snapshots, threads, messages.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "bench/support/scenes.h"
#include "server/formats/world_codec.h"
#include "server/world/published_state.h"
#include "shared/prop/limits.h"
#include "tests/support/flat_world.h"
#include "tests/support/joined_props.h"

namespace scree {
namespace {

constexpr int ticks_a_second = 60;

std::string refusal_of_joint(PropWorld& world, const Joint& joint) {
  return refusal_name(world.ask(AddJointRequest{joint}));
}

TEST(JointWorld, requests_are_refused_by_name) {
  JointWorld world(rock_world());
  const PieceId a = world.add(crate(), {0.0F, 3.0F, 0.0F}), b = world.add(crate(), {2.0F, 3.0F, 0.0F});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Joint good = joint_at(JointKind::hinge, world.frame(a), world.frame(b), {1.0F, 3.0F, 0.0F});
  const auto refused = [&](const auto& change) {
    Joint joint = good;
    change(joint);
    return refusal_of_joint(world, joint);
  };
  EXPECT_EQ(refused([&](Joint& j) { j.b.body = a; }), "joint_invalid") << "with itself";
  EXPECT_EQ(refused([&](Joint& j) { j.a.body = j.b.body = 0; }), "joint_invalid");
  EXPECT_EQ(refused([&](Joint& j) { j.b.body = 9999; }), "body_missing");
  EXPECT_EQ(refused([&](Joint& j) { j.a.place_m.x = nan; }), "joint_invalid");
  EXPECT_EQ(refused([&](Joint& j) { j.a.place_m.x = 1e9F; }), "joint_invalid");
  EXPECT_EQ(refused([&](Joint& j) { j.a.turn.w = nan; }), "joint_invalid");
  EXPECT_EQ(refused([&](Joint& j) { j.a.turn = {0.0F, 0.0F, 0.0F, 0.0F}; }), "joint_invalid");
  EXPECT_EQ(refused([&](Joint& j) { j.kind = static_cast<JointKind>(99); }), "joint_invalid");
  EXPECT_EQ(refused([&](Joint& j) { j.limits = JointLimits{1.0F, -1.0F}; }), "joint_invalid");
  EXPECT_EQ(refused([&](Joint& j) { j.limits = JointLimits{-nan, 1.0F}; }), "joint_invalid");
  EXPECT_EQ(refused([&](Joint& j) { j.motor.speed = nan; }), "joint_invalid");
  EXPECT_EQ(refused([&](Joint& j) { j.motor.greatest = -1.0F; }), "joint_invalid");
  EXPECT_EQ(refused([&](Joint& j) { j.break_force_n = nan; }), "joint_invalid");
  EXPECT_EQ(refused([&](Joint& j) { j.length_m = 1.0F; }), "joint_invalid") << "a hinge has no length";
  EXPECT_EQ(refused([&](Joint& j) { j.kind = JointKind::rope; }), "joint_invalid") << "a rope has one";
  EXPECT_EQ(refused([&](Joint& j) { j.a = {0, {0.0F, 50.0F, 0.0F}}; }), "joint_invalid") << "in the air";
  EXPECT_EQ(refused([&](Joint& j) { j.a = {0, {1e8F, 0.0F, 0.0F}}; }), "joint_invalid");
  Prop post = crate();
  post.motion = PropMotion::fixed;
  const PieceId c = world.add(post, {6.0F, 3.0F, 0.0F}), d = world.add(post, {9.0F, 3.0F, 0.0F});
  EXPECT_EQ(refused([&](Joint& j) { j.a.body = c, j.b.body = d; }), "joint_invalid") << "neither moves";
  EXPECT_EQ(refusal_name(world.ask(RemoveJointRequest{a})), "joint_missing");
  EXPECT_EQ(refusal_name(world.ask(SetMotorRequest{7777, {}})), "joint_missing");
  const JointId hinge = world.join(good), ball = world.join(JointKind::ball, a, c, {3.0F, 3.0F, 0.0F});
  EXPECT_EQ(refusal_name(world.ask(SetMotorRequest{hinge, {nan, 1.0F}})), "joint_invalid");
  EXPECT_EQ(refusal_name(world.ask(SetMotorRequest{ball, {1.0F, 1.0F}})), "joint_invalid");
  EXPECT_EQ(refusal_name(world.ask(RemoveJointRequest{hinge})), "");
  EXPECT_EQ(world.end(hinge), JointEnd::removed);
  EXPECT_EQ(refusal_name(world.ask(RemoveJointRequest{hinge})), "joint_missing");
}

TEST(JointWorld, a_joint_that_would_drag_its_bodies_together_is_refused) {
  JointWorld world(rock_world());
  const PieceId a = world.add_post({0.0F, 5.0F, 0.0F}), b = world.add(crate(), {6.0F, 5.0F, 0.0F});
  const auto moved = [&](JointKind kind, glm::vec3 off_m) {
    Joint joint = joint_at(kind, world.frame(a), world.frame(b), {3.0F, 5.0F, 0.0F}, {0, 0, 1});
    joint.b.place_m += off_m;
    return joint;
  };
  const float most_m = limits::joint_gap_max_m;
  for (const JointKind kind : {JointKind::fixed, JointKind::hinge, JointKind::ball}) {
    EXPECT_EQ(refusal_of_joint(world, moved(kind, {1.1F * most_m, 0, 0})), "joint_apart") << name_of(kind);
    EXPECT_EQ(refusal_of_joint(world, moved(kind, {0.8F * most_m, 0, 0})), "") << name_of(kind);
  }
  EXPECT_EQ(refusal_of_joint(world, moved(JointKind::slider, {0, 0, 5})), "") << "along its way";
  EXPECT_EQ(refusal_of_joint(world, moved(JointKind::slider, {0, 1.2F, 0})), "joint_apart") << "beside it";
  Joint slider = moved(JointKind::slider, {0, 0, 5});
  slider.limits = JointLimits{-1.0F, 2.0F};
  EXPECT_EQ(refusal_of_joint(world, slider), "joint_apart") << "beyond its end";
  Joint line =
      line_between(JointKind::rope, world.frame(a), world.place_m(a), world.frame(b), world.place_m(b));
  line.length_m = 4.5F;
  EXPECT_EQ(refusal_of_joint(world, line), "joint_apart") << "a rope that is too short";
  line.length_m = 100.0F;
  EXPECT_EQ(refusal_of_joint(world, line), "");
  line.kind = JointKind::distance;
  EXPECT_EQ(refusal_of_joint(world, line), "joint_apart");
}

TEST(JointWorld, no_more_joints_than_the_setting_allows) {
  WorldConfig config = rock_world();
  config.joints_max = 2;
  JointWorld world(config);
  const PieceId a = world.add(crate(), {0.0F, 0.5F, 0.0F}), b = world.add(crate(), {2.0F, 0.5F, 0.0F});
  const Joint joint = joint_at(JointKind::ball, world.frame(a), world.frame(b), {1.0F, 0.5F, 0.0F});
  world.join(joint);
  const JointId last = world.join(joint);
  EXPECT_EQ(refusal_of_joint(world, joint), "joints_max");
  world.ask(RemoveJointRequest{last});
  EXPECT_EQ(refusal_of_joint(world, joint), "");
}

TEST(JointWorld, ten_thousand_joints_between_two_crates_are_harmless) {
  WorldConfig config = rock_world();
  config.joints_max = 10000;
  JointWorld world(config);
  const PieceId a = world.add(crate(), {0.0F, 0.5F, 0.0F}), b = world.add(crate(), {2.0F, 0.5F, 0.0F});
  const Joint joint = joint_at(JointKind::ball, world.frame(a), world.frame(b), {1.0F, 0.5F, 0.0F});
  size_t made = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<Command> commands;
    for (uint32_t k = 0; k < 250; ++k) commands.push_back({0, k + 1, AddJointRequest{joint}});
    for (const Reply& reply : world.step(commands).replies) made += reply.joint ? 1U : 0U;
  }
  EXPECT_GT(made, 500U);
  world.steps(ticks_a_second);
  EXPECT_LT(glm::distance(world.place_m(a), glm::vec3(0.0F, 0.5F, 0.0F)), 1.0F);
  EXPECT_EQ(world.ask(RemovePropRequest{a}).refusal, "");
  EXPECT_GE(world.last().joints_removed.size(), made);
}

/// A plank that a pillar of rock holds by a hinge which does not turn.
struct Drawbridge {
  PieceId plank = 0;
  JointId hinge = 0;
};

Drawbridge build_drawbridge(JointWorld& world) {
  world.ask(FillRequest{box({-2.0F, 3.0F, 0.0F}, {1.0F, 3.0F, 2.0F})});
  Drawbridge bridge;
  bridge.plank = world.add(prop_of({.kind = PropPartKind::box, .half_m = {2.0F, 0.15F, 1.0F}}, 300.0F),
                           {1.2F, 4.0F, 0.0F});
  Joint hinge = joint_at(JointKind::hinge, {}, world.frame(bridge.plank), {-1.4F, 4.0F, 0.0F}, {0, 0, 1});
  hinge.limits = JointLimits{0.0F, 1.5F};
  bridge.hinge = world.join(hinge);
  return bridge;
}

TEST(JointWorld, a_drawbridge_falls_when_the_rock_about_its_hinge_is_carved_away) {
  JointWorld world(rock_world());
  const Drawbridge bridge = build_drawbridge(world);
  world.steps(3 * ticks_a_second);
  EXPECT_NEAR(world.place_m(bridge.plank).y, 4.0F, 0.1F);
  CarveRequest far;
  far.shape = sphere({-2.5F, 1.5F, 1.5F}, 0.5F);
  far.impact_m = {-2.5F, 1.5F, 2.5F};
  far.seeds = 2;
  world.ask(far);
  world.steps(ticks_a_second);
  EXPECT_NEAR(world.place_m(bridge.plank).y, 4.0F, 0.1F) << "other rock does not matter";
  CarveRequest carve = far;
  carve.shape = sphere({-1.4F, 4.0F, 0.0F}, 0.8F);
  carve.seeds = 8;
  world.ask(carve);
  EXPECT_EQ(world.end(bridge.hinge), JointEnd::let_go);
  world.steps(3 * ticks_a_second);
  EXPECT_LT(world.place_m(bridge.plank).y, 2.0F);
}

TEST(JointWorld, a_piece_that_breaks_loses_its_joints) {
  JointWorld world(rock_world());
  CarveRequest carve = blow_at(world.world().config().terrain, 0.0F, 0.0F, 2.0F, 4, 5);
  carve.blast_speed_m_s = 25.0F;
  world.ask(carve);
  world.steps(10);
  ASSERT_FALSE(world.last().pieces.empty());
  const PieceState piece = world.last().pieces.front();
  const Pose at = dequantise(piece.pose);
  const PieceId load = world.add(crate(0.3F, 10.0F), at.position_m + glm::vec3(0.0F, 3.0F, 0.0F));
  const JointId rope = world.join(line_between(JointKind::rope, {piece.id, at.position_m, at.rotation},
                                               at.position_m, world.frame(load), world.place_m(load)));
  EXPECT_EQ(world.ask(BreakRequest{piece.id, at.position_m, 6, 9}).refusal, "");
  EXPECT_EQ(world.end(rope), JointEnd::body_gone);
}

TEST(JointWorld, a_piece_that_merges_loses_its_joints) {
  JointWorld world(rock_world());
  CarveRequest carve = blow_at(world.world().config().terrain, 0.0F, 0.0F, 2.0F, 4, 5);
  world.ask(carve);
  ASSERT_FALSE(world.last().pieces.empty());
  const PieceId piece = world.last().pieces.front().id;
  const Pose at = dequantise(world.last().pieces.front().pose);
  const PieceId load = world.add(crate(0.3F, 10.0F), {0.0F, 4.0F, 0.0F});
  Joint joint = line_between(JointKind::rope, {piece, at.position_m, at.rotation}, at.position_m,
                             world.frame(load), world.place_m(load));
  joint.length_m += 3.0F;
  const JointId rope = world.join(joint);
  std::optional<JointEnd> end;
  for (int tick = 0; tick < 20 * ticks_a_second && !end; ++tick) {
    world.step();
    end = world.end(rope);
  }
  EXPECT_EQ(end, JointEnd::body_gone);
}

WorldConfig rough_world() {
  WorldConfig config;
  config.terrain = {TerrainKind::noise, 2, 0.25F};
  config.terrain.rows = config.palette->ground;
  return config;
}

/// The highest rock there.
float ground_m(JointWorld& world, float x_m, float z_m) {
  const Field& field = world.world().field();
  const float voxel_m = field.source().voxel_size_m;
  for (float y_m = 40.0F; y_m > -40.0F; y_m -= voxel_m) {
    const VoxelCoord v{static_cast<int>(std::floor(x_m / voxel_m)),
                       static_cast<int>(std::floor(y_m / voxel_m)),
                       static_cast<int>(std::floor(z_m / voxel_m))};
    const VoxelCoord first = first_voxel(brick_of(v));
    const int index = Brick::index(v.x - first.x, v.y - first.y, v.z - first.z);
    if (field.brick(brick_of(v)).codes[static_cast<size_t>(index)] < 0) return y_m;
  }
  return -40.0F;
}

// Its wheels reach beyond the chassis on both sides: where it turns over, it drives on.
TEST(JointWorld, a_car_drives_far_over_rough_ground) {
  JointWorld world(rough_world());
  constexpr float z_m = 20.0F;
  float high_m = -40.0F;
  for (float x = -2.5F; x <= 2.5F; x += 0.5F)
    for (float z = -1.5F; z <= 1.5F; z += 0.5F) high_m = std::max(high_m, ground_m(world, x, z_m + z));
  const Car car = add_car(world, {0.0F, high_m + 1.5F, z_m}, 8.0F);
  glm::vec3 before_m = world.place_m(car.chassis);
  float way_m = 0.0F;
  for (int tick = 0; tick < 120 * ticks_a_second && way_m < 200.0F; ++tick) {
    world.step();
    ASSERT_TRUE(world.has(car.chassis)) << tick;
    const glm::vec3 at_m = world.place_m(car.chassis);
    way_m += glm::length(glm::vec2(at_m.x - before_m.x, at_m.z - before_m.z));
    before_m = at_m;
    for (const PieceId wheel : car.wheels)
      ASSERT_NEAR(glm::distance(world.place_m(wheel), at_m), 1.723F, 0.05F)
          << "a wheel came off in tick " << tick;
  }
  EXPECT_GE(way_m, 200.0F);
}

/// A chain, a bridge, a car and broken rock.
void fill_joint_scene(JointWorld& world) {
  CarveRequest carve = blow_at(world.world().config().terrain, 8.0F, 0.0F, 2.0F, 24, 5);
  world.ask(carve);
  hang_chain(world, {4.0F, 9.0F, 0.0F}, 6);
  build_drawbridge(world);
  add_car(world, {0.0F, 1.0F, 6.0F}, 3.0F);
}

TEST(JointWorld, goes_the_same_way_by_any_number_of_threads) {
  std::vector<std::vector<uint64_t>> hashes;
  for (const size_t threads : {1, 2, 4}) {
    JointWorld world(rock_world(), threads);
    fill_joint_scene(world);
    std::vector<uint64_t>& of_ticks = hashes.emplace_back();
    for (int i = 0; i < 5 * ticks_a_second; ++i) of_ticks.push_back(world.step().state_hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(JointWorld, a_snapshot_is_the_world_and_goes_on_the_same_way_each_time) {
  JointWorld world(rock_world());
  fill_joint_scene(world);
  world.steps(ticks_a_second);
  const std::vector<uint8_t> bytes = encode(world.world().snapshot());
  std::vector<std::vector<uint64_t>> ways(3);
  for (size_t i = 0; i < 2; ++i) {
    const auto value = decode_world(bytes);
    ASSERT_TRUE(value) << value.error().message;
    auto restored = World::restore(*value);
    ASSERT_TRUE(restored) << restored.error().message;
    EXPECT_EQ(encode((*restored)->snapshot()), bytes);
    EXPECT_EQ((*restored)->moment().joints.size(), 11U);
    for (int tick = 0; tick < 2 * ticks_a_second; ++tick)
      ways[i].push_back((*restored)->step({})->state_hash);
  }
  world.world().renew();
  for (int tick = 0; tick < 2 * ticks_a_second; ++tick) ways[2].push_back(world.step().state_hash);
  EXPECT_EQ(ways[0], ways[1]);
  EXPECT_EQ(ways[0], ways[2]);
}

TEST(JointWorld, a_kept_world_with_joints_that_cannot_be_is_refused) {
  JointWorld world(rock_world());
  fill_joint_scene(world);
  const WorldSnapshot good = world.world().snapshot();
  const auto refused = [&](const auto& change) {
    WorldSnapshot value = good;
    change(value.moment.joints);
    return !World::restore(value).has_value();
  };
  using Records = std::vector<JointRecord>;
  const auto change_joint = [](JointRecord& record, const auto& change) {
    Joint joint = *record.joint;
    change(joint);
    record.joint = std::make_shared<const Joint>(joint);
  };
  EXPECT_FALSE(refused([](Records&) {}));
  EXPECT_TRUE(refused([](Records& joints) { joints.pop_back(); })) << "another hash";
  EXPECT_TRUE(refused([](Records& joints) { joints[1].id = joints[0].id; }));
  EXPECT_TRUE(refused([](Records& joints) { joints[0].id = 0; }));
  EXPECT_TRUE(refused([](Records& joints) { joints[0].id = 1U << 30U; }));
  EXPECT_TRUE(refused(
      [&](Records& joints) { change_joint(joints[0], [](Joint& joint) { joint.b.body = 999999; }); }));
  EXPECT_TRUE(refused(
      [&](Records& joints) { change_joint(joints[0], [](Joint& joint) { joint.b.body = joint.a.body; }); }));
}

TEST(JointWorld, the_published_state_follows) {
  JointWorld world(rock_world());
  PublishedState state;
  const auto follow = [&] { state.apply(world.last()); };
  const PieceId a = world.add(crate(), {0.0F, 2.0F, 0.0F});
  follow();
  const PieceId b = world.add(crate(), {2.0F, 2.0F, 0.0F});
  follow();
  const JointId hinge = world.join(JointKind::hinge, a, b, {1.0F, 2.0F, 0.0F});
  follow();
  ASSERT_TRUE(state.joints().contains(hinge));
  const uint64_t before = world.last().state_hash;
  world.ask(SetMotorRequest{hinge, {2.0F, 10.0F}});
  follow();
  EXPECT_NE(world.last().state_hash, before);
  EXPECT_EQ(state.joints().at(hinge)->motor.speed, 2.0F);
  PublishedState again;
  again.apply(state.as_delta());
  EXPECT_EQ(again.joints().size(), 1U);
  world.ask(RemovePropRequest{b});
  follow();
  EXPECT_EQ(world.end(hinge), JointEnd::body_gone);
  EXPECT_TRUE(state.joints().empty());
}

TEST(JointWorld, a_prop_and_its_joint_may_go_in_one_tick) {
  JointWorld world(rock_world());
  const PieceId a = world.add(crate(), {0.0F, 2.0F, 0.0F}), b = world.add(crate(), {2.0F, 2.0F, 0.0F});
  const JointId hinge = world.join(JointKind::hinge, a, b, {1.0F, 2.0F, 0.0F});
  world.step({{0, 1, RemovePropRequest{b}},
              {0, 2, SetMotorRequest{hinge, {1.0F, 1.0F}}},
              {0, 3, RemoveJointRequest{hinge}}});
  ASSERT_EQ(world.last().replies.size(), 3U);
  EXPECT_EQ(refusal_name(world.last().replies[1]), "joint_missing");
  EXPECT_EQ(refusal_name(world.last().replies[2]), "joint_missing");
  EXPECT_EQ(world.last().joints_removed.size(), 1U);
}

}  // namespace
}  // namespace scree
