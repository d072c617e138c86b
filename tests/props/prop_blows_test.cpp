// Props strike terrain and pieces as pieces do.
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/flat_world.h"
#include "tests/support/joined_props.h"

namespace scree {
namespace {

constexpr int ticks_per_second = 60;

/// It is of steel.
Prop heavy_ball() {
  return ball(0.39F, 2000.0F);
}

/// It is one voxel thick, at x = 10 m, in a thick frame.
void build_wall(PropWorld& world) {
  world.ask(FillRequest{box({10.0F, 3.0F, 0.0F}, {0.125F, 3.0F, 2.5F})});
  for (const float z : {-3.5F, 3.5F}) world.ask(FillRequest{box({10.0F, 3.5F, z}, {1.0F, 3.5F, 1.0F})});
  world.ask(FillRequest{box({10.0F, 6.5F, 0.0F}, {1.0F, 1.0F, 4.5F})});
}

/// Voxels that the terrain loses while a ball flies at a wall.
double lost_voxels(JointWorld& world, const Prop& prop, float speed_m_s, PieceId& id) {
  build_wall(world);
  world.steps(ticks_per_second / 2);
  const MassUnits before = world.last().ledger.terrain;
  id = world.add(prop, {8.5F, 3.0F, 0.0F}, {speed_m_s, 0.0F, 0.0F});
  world.steps(ticks_per_second / 4);
  return static_cast<double>(before - world.last().ledger.terrain) / units_per_voxel;
}

TEST(PropBlows, a_ball_of_two_tonnes_breaks_a_thin_wall_and_harder_ones_never_break_less) {
  double least = 0.0;
  for (const float speed_m_s : {0.5F, 8.0F, 15.0F, 30.0F, 60.0F}) {
    JointWorld world(rock_world());
    PieceId id = 0;
    Prop prop = heavy_ball();
    prop.gravity = 0.0F;
    const double lost = lost_voxels(world, prop, speed_m_s, id);
    const float left_m_s = world.speed_m_s(id);
    world.steps(ticks_per_second);
    std::printf("%4.1f m/s: %.0f voxels, %.1f m/s left\n", static_cast<double>(speed_m_s), lost,
                static_cast<double>(left_m_s));
    EXPECT_GE(lost, 0.9 * least) << speed_m_s;
    least = std::max(least, lost);
    if (speed_m_s < 1.0F) {
      EXPECT_EQ(lost, 0.0);
    }
    if (speed_m_s < 30.0F) continue;
    EXPECT_GT(lost, 8.0);
    EXPECT_LT(left_m_s, 0.97F * speed_m_s) << "breaking took energy";
    EXPECT_GT(world.place_m(id).x, 10.0F) << "it goes through";
  }
}

TEST(PropBlows, a_ball_falls_through_a_thin_roof) {
  for (const float height_m : {0.1F, 40.0F}) {
    JointWorld world(rock_world());
    world.ask(FillRequest{box({-3.0F, 2.0F, 0.0F}, {0.5F, 2.0F, 3.0F})});
    world.ask(FillRequest{box({3.0F, 2.0F, 0.0F}, {0.5F, 2.0F, 3.0F})});
    world.ask(FillRequest{box({0.0F, 4.0F, 0.0F}, {3.5F, 0.125F, 3.0F})});
    world.steps(ticks_per_second);
    const MassUnits before = world.last().ledger.terrain;
    const PieceId id = world.add(heavy_ball(), {0.0F, 4.6F + height_m, 0.0F});
    world.steps(5 * ticks_per_second);
    if (height_m > 1.0F) {
      EXPECT_LT(world.place_m(id).y, 2.0F);
    } else {
      EXPECT_EQ(world.last().ledger.terrain, before);
      EXPECT_GT(world.place_m(id).y, 4.0F);
    }
  }
}

TEST(PropBlows, a_bullet_breaks_nothing) {
  JointWorld world(rock_world());
  PieceId id = 0;
  EXPECT_EQ(lost_voxels(world, ball(0.02F, 0.05F), 600.0F, id), 0.0);
}

TEST(PropBlows, a_falling_crate_of_ten_tonnes_dents_soft_ground) {
  JointWorld world(flat_world());
  world.step();
  const MassUnits before = world.last().ledger.terrain;
  world.add(crate(1.0F, 10000.0F), {0.0F, 21.0F, 0.0F});
  MassUnits least = before;
  for (int i = 0; i < 3 * ticks_per_second; ++i) least = std::min(least, world.step().ledger.terrain);
  EXPECT_LT(least, before - 12 * units_per_voxel);
}

TEST(PropBlows, what_rests_does_not_grind_the_ground_away) {
  JointWorld world(flat_world());
  for (int i = 0; i < 10; ++i) world.add(crate(), {0.0F, 0.5F + static_cast<float>(i), 0.0F});
  world.add(crate(0.3F, 20.0F), {6.0F, 0.3F, 0.0F});
  world.add(crate(0.8F, 10000.0F), {6.0F, 1.4F, 0.0F});  // presses the light one down
  Prop press = crate(0.5F);
  press.motion = PropMotion::kinematic;
  world.add(crate(), {-6.0F, 0.5F, 0.0F});
  const PieceId id = world.add(press, {-6.0F, 1.5F, 0.0F});
  world.steps(ticks_per_second);
  const uint64_t before = world.last().field_hash;
  world.ask(MovePropRequest{id, {}, {}, glm::vec3(0.0F, -0.1F, 0.0F)});
  world.steps(ticks_per_second);
  world.ask(MovePropRequest{id, {}, {}, glm::vec3(0.0F)});
  for (int i = 0; i < 58 * ticks_per_second; ++i) ASSERT_TRUE(world.step().operations.empty()) << i;
  EXPECT_EQ(world.last().field_hash, before);
}

/// The first piece that a block in the air becomes.
PieceId drop_block(PropWorld& world, glm::vec3 middle_m, float half_m) {
  world.ask(FillRequest{box(middle_m, glm::vec3(half_m))});
  for (int i = 0; i < ticks_per_second && world.last().pieces.empty(); ++i) world.step();
  EXPECT_EQ(world.last().pieces.size(), 1U);
  return world.last().pieces.empty() ? 0 : world.last().pieces.front().id;
}

glm::vec3 place_of_piece(const PropWorld& world, PieceId id) {
  for (const PieceState& piece : world.last().pieces)
    if (piece.id == id) return dequantise(piece.pose).position_m;
  ADD_FAILURE() << "no piece " << id;
  return {};
}

TEST(PropBlows, a_ball_breaks_a_piece_of_rock_if_it_is_fast) {
  for (const float speed_m_s : {3.0F, 60.0F}) {
    JointWorld world(rock_world());
    const PieceId block = drop_block(world, {0.0F, 40.0F, 0.0F}, 0.75F);
    const glm::vec3 at_m = place_of_piece(world, block);
    const glm::vec3 falls_m_s = world.motion(block).velocity_m_s;
    const PieceId id =
        world.add(heavy_ball(), at_m - glm::vec3(1.5F, 0.0F, 0.0F), falls_m_s + glm::vec3(speed_m_s, 0, 0));
    world.steps(ticks_per_second / 2);
    const float forward_m_s = world.motion(id).velocity_m_s.x;
    EXPECT_EQ(world.last().pieces.size() > 1U, speed_m_s > 10.0F);
    EXPECT_LT(forward_m_s, 0.6F * speed_m_s);
  }
}

TEST(PropBlows, a_rock_of_twenty_tonnes_tells_its_energy_to_what_it_falls_on) {
  for (const PropMotion motion : {PropMotion::dynamic, PropMotion::fixed}) {
    WorldConfig config = rock_world();
    config.methods.impacts = false;  // or it breaks in its first tick
    JointWorld world(config);
    Prop prop = crate(0.5F, 10000.0F);
    prop.motion = motion;
    const PieceId id = world.add(prop, {0.0F, 0.5F, 0.0F}),
                  rock = drop_block(world, {0.0F, 5.0F, 0.0F}, 1.0F);
    const float kg = 8.0F * builtin_palette().rows.front().density_kg_m3;
    EXPECT_NEAR(kg, 20000.0F, 3000.0F);
    float told_j = 0.0F, has_j = 0.0F;
    for (int i = 0; i < ticks_per_second; ++i) {
      const float speed_m_s = world.speed_m_s(rock);
      for (const ContactEvent& contact : world.step().contacts)
        if (contact.body == id && contact.other == rock) told_j = std::max(told_j, contact.energy_j);
      if (told_j == 0.0F) has_j = 0.5F * kg * speed_m_s * speed_m_s;
    }
    std::printf("it has %.0f J, and %.0f J are told\n", static_cast<double>(has_j),
                static_cast<double>(told_j));
    EXPECT_NEAR(told_j / has_j, 1.0F, 0.15F);
  }
}

TEST(PropBlows, what_bears_a_heavy_load_strikes_nothing) {
  JointWorld world(rock_world());
  world.add(crate(0.3F, 20.0F), {0.0F, 0.3F, 0.0F});
  world.add(crate(0.8F, 10000.0F), {0.0F, 1.4F, 0.0F});
  world.steps(2 * ticks_per_second);
  for (int i = 0; i < ticks_per_second; ++i) ASSERT_TRUE(world.step().contacts.empty()) << i;
}

TEST(PropBlows, go_the_same_way_by_any_number_of_threads) {
  std::vector<std::vector<uint64_t>> hashes;
  for (const size_t threads : {1, 2, 4}) {
    JointWorld world(rock_world(), threads);
    build_wall(world);
    world.add(heavy_ball(), {8.0F, 3.0F, 0.0F}, {30.0F, 0.0F, 0.0F});
    world.add(crate(1.0F, 10000.0F), {-8.0F, 20.0F, 0.0F});
    drop_block(world, {-4.0F, 20.0F, 3.0F}, 1.0F);
    std::vector<uint64_t>& of_ticks = hashes.emplace_back();
    for (int i = 0; i < 4 * ticks_per_second; ++i) of_ticks.push_back(world.step().state_hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

}  // namespace
}  // namespace scree
