// The scenes that a world and its mirrors give for questions about space.
#include <gtest/gtest.h>

#include "client/mirror/mirror.h"
#include "proto/transforms.h"
#include "shared/base/random.h"
#include "shared/query/query.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

/// A mirror that is told all of a world's ticks: operations, props whole, and poses as published.
class SceneFollower {
 public:
  explicit SceneFollower(const TerrainSource& terrain) : mirror_(welcome_to(terrain)) {}

  void follow(const TickDelta& delta) {
    FrameMessage frame;
    frame.tick = delta.tick;
    for (const AppliedOperation& applied : delta.operations) frame.operations.push_back(applied.operation);
    for (const auto& [id, prop] : mirror_.props())
      if (std::ranges::find(delta.props, id, &PieceState::id) == delta.props.end())
        frame.removed_pieces.push_back(id);
    apply(frame);
    for (const SpawnedProp& spawned : delta.props_spawned) apply(PropMessage{spawned.id, *spawned.prop, {}});
    std::vector<PieceState> poses = delta.pieces;
    poses.insert(poses.end(), delta.props.begin(), delta.props.end());
    std::ranges::sort(poses, {}, &PieceState::id);
    FrameMessage moved;
    moved.tick = delta.tick;
    moved.transforms = pack_transforms(poses);
    apply(moved);
  }
  Mirror& mirror() { return mirror_; }

 private:
  static WelcomeMessage welcome_to(const TerrainSource& terrain) {
    WelcomeMessage welcome;
    welcome.terrain = terrain;
    return welcome;
  }
  void apply(const ServerMessage& message) {
    const auto applied = mirror_.apply(message);
    ASSERT_TRUE(applied.has_value()) << applied.error().message;
  }

  Mirror mirror_;
};

WorldConfig scene_config() {
  WorldConfig config;
  config.terrain = {TerrainKind::noise, 3, 0.5F};
  return config;
}

glm::vec3 any_place(Random& random, float half_m) {
  const auto part = [&] { return (random.unit() * 2.0F - 1.0F) * half_m; };
  const float x = part(), y = part();
  return {x, y, part()};
}

glm::vec3 any_direction(Random& random) {
  for (;;) {
    const glm::vec3 v = any_place(random, 1.0F);
    if (glm::dot(v, v) > 0.1F) return glm::normalize(v);
  }
}

struct Counts {
  int hits = 0, bodies = 0, pieces = 0;
};

void expect_same_answers(const QueryScene& a, const QueryScene& b, glm::vec3 about_m, uint32_t seed,
                         Counts& counts) {
  Random random(seed);
  for (int i = 0; i < 60; ++i) {
    const glm::vec3 from = about_m + any_place(random, 8.0F), unit = any_direction(random);
    const auto ray = cast_ray(a, from, unit, 30.0F);
    ASSERT_EQ(ray->answer, cast_ray(b, from, unit, 30.0F)->answer);
    const auto ball = cast_sphere(a, from, unit, 10.0F, 0.4F);
    ASSERT_EQ(ball->answer, cast_sphere(b, from, unit, 10.0F, 0.4F)->answer);
    ASSERT_EQ(nearest_surface(a, from, 4.0F)->answer, nearest_surface(b, from, 4.0F)->answer);
    ASSERT_EQ(is_solid(a, from)->answer, is_solid(b, from)->answer);
    ASSERT_EQ(overlap_sphere(a, from, 2.0F)->answer, overlap_sphere(b, from, 2.0F)->answer);
    ASSERT_EQ(solids_in(a, from - 4.0F, from + 4.0F)->answer, solids_in(b, from - 4.0F, from + 4.0F)->answer);
    const auto content = box_content(a, from - 2.0F, from + 2.0F)->answer;
    const auto other = box_content(b, from - 2.0F, from + 2.0F)->answer;
    ASSERT_EQ(content.rock_m3, other.rock_m3);
    ASSERT_EQ(content.masses, other.masses);
    counts.hits += ray->answer ? 1 : 0;
    counts.pieces += ray->answer && ray->answer->kind == HitKind::piece ? 1 : 0;
    counts.bodies += ray->answer && ray->answer->kind == HitKind::body ? 1 : 0;
  }
}

TEST(Scene, a_world_and_a_mirror_that_follows_it_answer_with_the_same_bits) {
  PropWorld world(scene_config());
  SceneFollower follower(world.world().config().terrain);  // with the palette's rows of rubble
  const auto step = [&](const std::vector<Command>& commands) { follower.follow(world.step(commands)); };
  step({});
  const auto ground = cast_ray(world.world().scene(), {0.0F, 200.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 400.0F);
  ASSERT_TRUE(ground && ground->answer);
  const glm::vec3 top_m = ground->answer->place_m;
  Prop table = crate(0.6F);
  table.parts.push_back(
      {.kind = PropPartKind::capsule, .place_m = {0.0F, 1.0F, 0.0F}, .half_m = {0.3F, 0.5F, 0}});
  table.parts.push_back({.kind = PropPartKind::cylinder, .place_m = {1.0F, 0, 0}, .half_m = {0.4F, 0.5F, 0}});
  uint32_t request = 1;
  for (int i = 0; i < 5; ++i)
    step({{0, request++,
           AddPropRequest{i % 2 == 0 ? table : ball(0.7F, 50.0F), top_m + glm::vec3(2 * i - 5, 4, 1)}}});
  Counts counts;
  for (int round = 0; round < 4; ++round) {
    CarveRequest carve;
    carve.shape = sphere(top_m + glm::vec3(static_cast<float>(2 * round) - 3.0F, 0.0F, 0.0F), 1.5F);
    carve.pattern = SeedPattern::uniform;
    carve.seeds = 6;
    carve.random_seed = static_cast<uint32_t>(round);
    carve.impact_m = carve.shape.a;
    carve.blast_speed_m_s = 6.0F;
    step({{0, request++, carve}});
    for (int i = 0; i < 12; ++i) {
      step({});
      ASSERT_EQ(follower.mirror().field().hash(), world.last().field_hash) << round << ", " << i;
      if (i % 4 == 3)
        expect_same_answers(world.world().scene(), follower.mirror().scene(), top_m + glm::vec3(0, 1, 0),
                            static_cast<uint32_t>(100 * round + i), counts);
    }
  }
  EXPECT_EQ(follower.mirror().tick(), world.world().tick());
  EXPECT_GT(counts.hits, 100);
  EXPECT_GT(counts.bodies, 5);
  EXPECT_GT(counts.pieces, 3);
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

TEST(Scene, of_two_thousand_bodies_has_each_of_them) {
  WorldConfig config = scene_config();
  config.props_max = 4096;
  PropWorld world(config);
  Prop shelf = crate(0.4F);
  shelf.motion = PropMotion::fixed;
  shelf.parts.push_back(
      {.kind = PropPartKind::sphere, .place_m = {0.0F, 1.0F, 0.0F}, .half_m = glm::vec3(0.3F)});
  constexpr int shelves = 2000, at_once = 100;
  for (int i = 0; i < shelves; i += at_once) {
    std::vector<Command> commands;
    for (int j = i; j < i + at_once; ++j)
      commands.push_back(
          {0, static_cast<uint32_t>(j + 1),
           AddPropRequest{shelf, glm::vec3(2 * (j % 50), 100 + 3 * (j / 1000), 2 * (j / 50 % 20))}});
    world.step(commands);
    // A client may have few requests waiting at once.
    for (int wait = 0; wait < 100 && std::cmp_less(world.last().props.size(), i + at_once); ++wait)
      world.step();
  }
  const HeldScene scene = world.world().scene();
  EXPECT_EQ(scene.scene().solids().size(), 2000U);
  for (int i = 0; i < shelves; i += 37) {
    const glm::vec3 place_m(2 * (i % 50), 100 + 3 * (i / 1000), 2 * (i / 50 % 20));
    const auto hit = cast_ray(scene, place_m + glm::vec3(0.0F, 0.0F, -0.9F), {0.0F, 0.0F, 1.0F}, 2.0F);
    ASSERT_TRUE(hit && hit->answer) << i;
    EXPECT_NEAR(hit->answer->distance_m, 0.5F, 0.01F) << i;
  }
}

}  // namespace
}  // namespace scree
