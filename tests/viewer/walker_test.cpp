// A person on foot: never through rock, never stuck.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <numbers>

#include "client/viewer/session/on_foot.h"
#include "shared/base/random.h"
#include "shared/operation/operation.h"
#include "shared/person/solid_ground.h"

namespace scree {
namespace {

constexpr float frame_s = 1.0F / 60.0F;
/// What the body may overlap rock by: its skin, and what a trilinear field bends within a step.
constexpr float depth_max_m = Walker::skin_m + 0.02F;

glm::vec3 heading(float angle) {
  return {std::cos(angle), 0.0F, std::sin(angle)};
}

/// A plane through the origin, and nothing loose.
class PlaneGround final : public WalkGround {
 public:
  explicit PlaneGround(float slope_degrees) {
    const float angle = slope_degrees * std::numbers::pi_v<float> / 180.0F;
    normal_ = {-std::sin(angle), std::cos(angle), 0.0F};  // rises along x
  }
  Touch rock(glm::vec3 place_m) override { return {glm::dot(place_m, normal_), normal_}; }
  Touch loose(glm::vec3) override { return {1e9F, {}}; }

 private:
  glm::vec3 normal_;
};

void walk(Walker& walker, WalkGround& ground, const WalkInput& input, float seconds) {
  for (float t = 0.0F; t < seconds; t += frame_s) walker.step(input, frame_s, ground);
}

TEST(Walker, walks_up_what_is_not_too_steep_and_stays_there) {
  PlaneGround slope(40.0F);
  Walker walker({0.0F, 0.5F, 0.0F});
  walk(walker, slope, {.go = {1.0F, 0.0F, 0.0F}}, 2.0F);
  EXPECT_GT(walker.feet_m().y, 4.0F);
  EXPECT_TRUE(walker.stands());
  const glm::vec3 top_m = walker.feet_m();
  walk(walker, slope, {}, 2.0F);
  EXPECT_LT(glm::distance(walker.feet_m(), top_m), 0.3F);
}

TEST(Walker, covers_its_way_at_three_frames_a_second_as_at_sixty) {
  PlaneGround flat(0.0F);
  Walker slow({0.0F, 0.0F, 0.0F}), quick({0.0F, 0.0F, 0.0F});
  const WalkInput ahead{.go = {1.0F, 0.0F, 0.0F}};
  for (int i = 0; i < 9; ++i) slow.step(ahead, 1.0F / 3.0F, flat);
  for (int i = 0; i < 180; ++i) quick.step(ahead, 1.0F / 60.0F, flat);
  EXPECT_NEAR(slow.feet_m().x, quick.feet_m().x, 0.1F);
  EXPECT_GT(quick.feet_m().x, 6.0F);
}

TEST(Walker, slides_down_what_is_too_steep) {
  PlaneGround slope(65.0F);
  Walker walker({0.0F, 1.0F, 0.0F});
  walk(walker, slope, {.go = {1.0F, 0.0F, 0.0F}}, 2.0F);
  EXPECT_LT(walker.feet_m().y, 0.0F);
}

TEST(Walker, jumps_from_the_ground_only) {
  PlaneGround flat(0.0F);
  Walker walker({0.0F, 0.0F, 0.0F});
  walk(walker, flat, {}, 0.5F);
  float top_m = 0.0F;
  for (int i = 0; i < 240; ++i) {
    walker.step({.jump = i < 40}, frame_s, flat);
    top_m = std::max(top_m, walker.feet_m().y);
  }
  EXPECT_GT(top_m, 0.9F);
  EXPECT_LT(top_m, 1.4F);
  EXPECT_TRUE(walker.stands());
  EXPECT_NEAR(walker.feet_m().y, 0.0F, 0.05F);
}

/// A field, and pieces cut from it that never come to rest.
struct World {
  MapField field{{TerrainKind::noise, 4, 0.25F}};
  ScenePieces pieces;
  std::map<PieceId, glm::vec3> homes_m;

  float ground_m(float x_m, float z_m) const { return ground_height_m(field.source(), x_m, z_m); }
  void carve(int carves, float half_m, Random& random) {
    PieceTable table;
    for (int i = 0; i < carves; ++i) {
      const float x_m = (random.unit() * 2.0F - 1.0F) * half_m, z_m = (random.unit() * 2.0F - 1.0F) * half_m;
      const glm::vec3 at_m(x_m, ground_m(x_m, z_m), z_m);
      const auto id = static_cast<PieceId>(1 + i * 64);
      apply(CarveOperation{sphere(at_m, 1.0F + 1.5F * random.unit()), SeedPattern::uniform, 12, 5, at_m, id},
            field, table);
    }
    for (const auto& [id, volume] : table) {
      homes_m[id] = volume->centre_voxels * field.source().voxel_size_m;
      pieces[id] = {volume, {homes_m[id], {1.0F, 0.0F, 0.0F, 0.0F}}};
    }
  }
  void move_pieces(float now_s) {
    for (auto& [id, piece] : pieces) {
      const float phase = now_s * 2.0F + static_cast<float>(id);
      piece.pose = {
          homes_m[id] + glm::vec3(std::sin(phase), 0.5F * std::sin(phase * 0.7F), std::cos(phase)) * 0.8F,
          glm::angleAxis(phase, glm::normalize(glm::vec3(1.0F, 2.0F, 3.0F)))};
    }
  }
};

/// How far one comes from there by going and jumping, in the best of eight directions.
float way_open_m(const Walker& from, WalkGround& ground) {
  float best_m = 0.0F;
  for (int i = 0; i < 8; ++i) {
    Walker walker = from;
    const WalkInput input{heading(static_cast<float>(i) * std::numbers::pi_v<float> / 4.0F), false, true};
    walk(walker, ground, input, 1.0F);
    best_m = std::max(best_m, glm::distance(walker.feet_m(), from.feet_m()));
  }
  return best_m;
}

/// A walk at random of some seconds; checks each frame.
void walk_at_random(World& world, Random& random, bool rubble, float seconds) {
  const float x_m = (random.unit() * 2.0F - 1.0F) * 10.0F, z_m = (random.unit() * 2.0F - 1.0F) * 10.0F;
  Walker walker({x_m, world.ground_m(x_m, z_m) + 1.0F, z_m});
  WalkInput input;
  float turn_s = 0.0F;
  for (float now_s = 0.0F; now_s < seconds; now_s += frame_s) {
    if (now_s >= turn_s) {
      turn_s = now_s + 0.3F + random.unit();
      input.go = heading(random.unit() * 2.0F * std::numbers::pi_v<float>);
      input.fast = random.unit() < 0.4F;
    }
    input.jump = random.unit() < 0.05F;
    if (rubble) world.move_pieces(now_s);
    SolidGround ground = ground_of_scene(Scene{world.field, world.pieces}, walker.feet_m());
    walker.step(input, frame_s, ground);
    ASSERT_LE(Walker::depth_m(walker.feet_m(), ground), depth_max_m) << "at " << now_s << " s";
  }
  SolidGround ground = ground_of_scene(Scene{world.field, world.pieces}, walker.feet_m());
  EXPECT_GT(way_open_m(walker, ground), 0.5F);
}

TEST(Walker, hundred_walks_on_carved_ground_never_enter_rock_and_never_get_stuck) {
  World world;
  Random random(7);
  world.carve(60, 10.0F, random);
  world.pieces.clear();
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    walk_at_random(world, random, false, 4.0F);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Walker, walks_on_rubble_that_moves_never_enter_rock_and_never_get_stuck) {
  World world;
  Random random(9);
  world.carve(20, 6.0F, random);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    walk_at_random(world, random, true, 2.0F);
    if (testing::Test::HasFailure()) return;
  }
}

/// A stone of a metre and a half that comes to a walker on flat ground, from there and with that speed, until
/// it is at rest or past; where the walker is then.
Walker struck_by_a_stone(glm::vec3 from_m, glm::vec3 speed_m_s) {
  World world;
  PieceTable table;
  apply(
      CarveOperation{
          sphere({0.0F, world.ground_m(0.0F, 0.0F) - 2.0F, 0.0F}, 0.75F), SeedPattern::uniform, 1, 5, {}, 1},
      world.field, table);
  const std::shared_ptr<const Volume> stone = table.begin()->second;
  const MapField flat({TerrainKind::flat, 1, 0.25F});
  Walker walker({0.0F, 0.1F, 0.0F});
  ScenePieces pieces;
  pieces[1] = {stone, {from_m, {1.0F, 0.0F, 0.0F, 0.0F}}};
  for (float now_s = 0.0F; now_s < 1.5F; now_s += frame_s) {
    glm::vec3& place_m = pieces[1].pose.position_m;
    place_m += speed_m_s * frame_s;
    place_m.y = std::max(place_m.y, 0.75F);
    SolidGround ground = ground_of_scene(Scene{flat, pieces}, walker.feet_m());
    walker.step({}, frame_s, ground);
    EXPECT_LE(Walker::depth_m(walker.feet_m(), ground), depth_max_m) << "at " << now_s << " s";
  }
  return walker;
}

TEST(Walker, is_pushed_aside_by_a_stone_that_rolls_into_the_way) {
  const Walker walker = struck_by_a_stone({-4.0F, 0.75F, 0.1F}, {3.0F, 0.0F, 0.0F});
  EXPECT_GT(glm::length(glm::vec2(walker.feet_m().x - 0.5F, walker.feet_m().z - 0.1F)), 0.75F)
      << "not within it";
  EXPECT_GT(glm::length(walker.feet_m()), 0.5F);
  EXPECT_TRUE(walker.stands());
}

TEST(Walker, is_pushed_aside_by_a_stone_that_falls) {
  const Walker walker = struck_by_a_stone({-0.5F, 6.0F, 0.2F}, {0.0F, -8.0F, 0.0F});
  EXPECT_GT(glm::distance(walker.feet_m(), glm::vec3(-0.5F, walker.feet_m().y, 0.2F)), 0.75F)
      << "not under it";
  EXPECT_TRUE(walker.stands());
}

TEST(Walker, climbs_a_step_and_is_stopped_by_a_wall) {
  MapField field({TerrainKind::flat, 1, 0.25F});
  PieceTable table;
  const float ground_m = ground_height_m(field.source(), 0.0F, 0.0F);
  apply(FillOperation{box({4.0F, ground_m, 0.0F}, {2.0F, 0.4F, 4.0F})}, field, table);
  apply(FillOperation{box({9.0F, ground_m, 0.0F}, {1.0F, 3.5F, 4.0F})}, field, table);
  const ScenePieces pieces;
  SolidGround ground = ground_of_scene(Scene{field, pieces}, {4.0F, ground_m, 0.0F});
  Walker walker({0.0F, ground_m + 0.5F, 0.0F});
  walk(walker, ground, {.go = {1.0F, 0.0F, 0.0F}}, 1.1F);
  EXPECT_NEAR(walker.feet_m().y, ground_m + 0.4F, 0.1F);  // on the step
  walk(walker, ground, {.go = {1.0F, 0.0F, 0.0F}, .fast = true}, 2.0F);
  EXPECT_LT(walker.feet_m().x, 8.0F);  // at the wall
  EXPECT_LE(Walker::depth_m(walker.feet_m(), ground), depth_max_m);
}

TEST(Walker, rises_out_of_rock_that_is_filled_over) {
  MapField field({TerrainKind::flat, 1, 0.25F});
  PieceTable table;
  const float ground_m = ground_height_m(field.source(), 0.0F, 0.0F);
  const ScenePieces pieces;
  Walker walker({0.0F, ground_m + 0.1F, 0.0F});
  apply(FillOperation{sphere({0.0F, ground_m, 0.0F}, 3.0F)}, field, table);
  SolidGround ground = ground_of_scene(Scene{field, pieces}, walker.feet_m());
  walk(walker, ground, {}, 3.0F);
  EXPECT_GT(walker.feet_m().y, ground_m + 2.5F);
  EXPECT_LE(Walker::depth_m(walker.feet_m(), ground), depth_max_m);
  EXPECT_TRUE(walker.stands());
}

TEST(Walker, the_same_walk_in_other_frames_ends_in_the_same_place) {
  World world;
  Random random(7);
  world.carve(20, 6.0F, random);
  world.pieces.clear();
  const auto end_m = [&](float every_s, int frames) {
    SolidGround ground = ground_of_scene(Scene{world.field, world.pieces}, {});
    Walker walker({1.0F, world.ground_m(1.0F, 1.0F) + 1.0F, 1.0F});
    for (int i = 0; i < frames; ++i) walker.step({.go = {1.0F, 0.0F, 0.3F}}, every_s, ground);
    return walker.feet_m();
  };
  EXPECT_LT(glm::distance(end_m(1.0F / 64.0F, 128), end_m(1.0F / 32.0F, 64)), 0.1F);
}

TEST(OnFoot, carries_the_camera_and_flies_on_from_there) {
  World world;
  Camera camera;
  camera.eye_m = {0.0F, world.ground_m(0.0F, 0.0F) + 5.0F, 0.0F};
  OnFoot feet;
  feet.change(camera);
  for (int i = 0; i < 120; ++i) feet.step(camera, {}, frame_s, Scene{world.field, world.pieces});
  EXPECT_NEAR(camera.eye_m.y, world.ground_m(0.0F, 0.0F) + Walker::eye_above_m, 0.6F);
  feet.change(camera);
  EXPECT_FALSE(feet.walks());
}

}  // namespace
}  // namespace scree
