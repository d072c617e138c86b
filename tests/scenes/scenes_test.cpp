// Every scene: it is built and stands, its strikes break it, all of it comes to rest, mass is exact at every
// tick, and the hashes do not depend on the number of threads.
#include <gtest/gtest.h>
#include <set>

#include "content/builtin_palette.h"
#include "server/app/ground_giver.h"
#include "server/app/saved_world.h"
#include "shared/field/material_window.h"
#include "tests/support/test_folder.h"
#include "tools/scenes/build.h"

namespace scree {

/// How a scene is named in reports of tests.
static void PrintTo(const SceneRow& scene, std::ostream* out) {
  *out << scene.name;
}

namespace {

constexpr int ticks_between_strikes = 20;
constexpr int rest_ticks_max = 3600;

class ScenesTest : public ::testing::TestWithParam<SceneRow> {
 protected:
  void SetUp() override {
    auto set_up = GetParam().set_up(folder / "");
    ASSERT_TRUE(set_up) << set_up.error().message;
    scene = std::move(*set_up);
  }
  std::unique_ptr<World> world(size_t threads = 1) const {
    auto built = scene_world(scene, threads);
    EXPECT_TRUE(built) << built.error().message;
    return built ? std::move(*built) : nullptr;
  }

  TestFolder folder;
  SceneSetup scene;
};

TEST_P(ScenesTest, stands_as_it_is_built_and_a_server_finds_it_in_a_file) {
  const auto built = world();
  ASSERT_NE(built, nullptr);
  const uint64_t hash = built->field().hash();
  MassUnits poured = 0;
  bool slides = false;
  for (int tick = 0; tick < 60; ++tick) {
    const auto delta = built->step({});
    ASSERT_TRUE(delta->pieces.empty()) << "falls at tick " << tick;
    ASSERT_EQ(delta->ledger.error(), 0);
    poured = delta->ledger.poured;
    for (const AppliedOperation& applied : delta->operations)
      slides |= std::holds_alternative<SlideOperation>(applied.operation);
  }
  // Its heaps of gravel and banks of snow are boxes: they slide to their angles, from the first tick on.
  EXPECT_EQ(slides, std::string(GetParam().name) == "street");
  if (!slides) {
    EXPECT_EQ(built->field().hash(), hash);
  }
  EXPECT_EQ(poured > 0, !scene.build.empty());
  MapField field(scene.config.terrain);
  build_scene(field, scene);
  if (!slides) {
    EXPECT_EQ(field.hash(), hash) << "a field alone is built otherwise";
  }
  for (const CarveRequest& strike : scene.strikes)
    EXPECT_LT(glm::length(centre_of(strike.shape) - scene.eye_m), 64.0F) << "too far to be seen";
  const std::string path = folder / "scene.world";
  const auto made = make_scene_file(scene, path, 7);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_FALSE(make_scene_file(scene, path, 8)) << "a file is never written over";
  const auto saved = SavedWorld::open(path, WorldConfig(), 1, ground_giver(path, WorldConfig()));
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_EQ((*saved)->number(), 7U);
  EXPECT_EQ((*saved)->release_world()->field().hash(), hash);
}

TEST_P(ScenesTest, strikes_break_it_and_all_of_it_comes_to_rest) {
  const auto alone = world(1), shared = world(2);
  ASSERT_NE(alone, nullptr);
  ASSERT_NE(shared, nullptr);
  ASSERT_FALSE(scene.strikes.empty());
  size_t struck = 0, made = 0;
  MassUnits terrain = 0;
  for (int tick = 0; tick < rest_ticks_max; ++tick) {
    std::vector<Command> commands;
    if (tick % ticks_between_strikes == 0 && struck < scene.strikes.size())
      commands.push_back({.body = scene.strikes[struck++]});
    const auto delta = alone->step(commands);
    ASSERT_EQ(delta->state_hash, shared->step(commands)->state_hash) << "at tick " << tick;
    ASSERT_EQ(delta->ledger.error(), 0) << "at tick " << tick;
    for (const Reply& reply : delta->replies) {
      EXPECT_EQ(reply.refusal, "");
      EXPECT_GE(reply.pieces, 4U) << "strike " << struck << " breaks nothing";
    }
    made += delta->spawned.size();
    terrain = delta->ledger.terrain;
    if (delta->pieces.empty() && struck == scene.strikes.size()) break;
  }
  const auto last = alone->step({});  // what lies on a prop does not merge
  EXPECT_TRUE(last->pieces.empty() || !last->props.empty()) << "is not at rest";
  EXPECT_GE(made, 4 * scene.strikes.size());
  EXPECT_EQ(alone->measure_terrain(), terrain);
}

INSTANTIATE_TEST_SUITE_P(All, ScenesTest, ::testing::ValuesIn(all_scenes().begin(), all_scenes().end()),
                         [](const auto& info) {
                           std::string name(info.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

/// The terrain that a scene's strikes loosen, pieces without the blow of one.
size_t islands_of(const std::string& name) {
  const TestFolder folder;
  const auto scene = scene_named(name)->set_up(folder / "");
  EXPECT_TRUE(scene) << scene.error().message;
  const auto world = scene_world(*scene);
  EXPECT_TRUE(world) << world.error().message;
  size_t islands = 0;
  const auto step = [&](const std::vector<Command>& commands) {
    const auto delta = (*world)->step(commands);
    for (const AppliedOperation& applied : delta->operations)
      islands += std::holds_alternative<IslandOperation>(applied.operation) ? 1 : 0;
  };
  for (const CarveRequest& strike : scene->strikes) {
    step({{.body = strike}});
    for (int tick = 0; tick < 30; ++tick) step({});
  }
  return islands;
}

TEST(SceneTableTest, the_arch_the_tower_and_the_bridge_fall_when_they_are_struck) {
  for (const char* name : {"arch", "tower", "bridge"}) EXPECT_GE(islands_of(name), 1U) << name;
}

TEST(SceneTableTest, the_street_is_of_all_materials_of_the_built_in_palette) {
  const TestFolder folder;
  const auto scene = scene_named("street")->set_up(folder / "");
  ASSERT_TRUE(scene);
  MapField field(scene->config.terrain);
  build_scene(field, *scene);
  std::set<Material> found;
  for (const ChunkCoord chunk : field.edited_chunks())
    for (const BrickCoord brick : field.edited_bricks(chunk)) {
      const BrickRock rock = materials_of(field, brick);
      const Brick codes = field.brick(brick);
      for (size_t i = 0; i < rock.size(); ++i)
        if (codes.codes[i] < 0) found.insert(rock[i]);
    }
  for (size_t row = 0; row < builtin_palette().rows.size(); ++row)
    EXPECT_EQ(found.contains(static_cast<Material>(row)), !builtin_palette().rows[row].rubble) << row;
}

TEST(SceneTableTest, ten_scenes_have_names_of_their_own) {
  EXPECT_EQ(all_scenes().size(), 10U);
  for (const SceneRow& row : all_scenes()) EXPECT_EQ(scene_named(row.name), &row) << row.name;
  EXPECT_EQ(scene_named("nowhere"), nullptr);
  EXPECT_NE(scene_names().find("maunga-whau"), std::string::npos);
}

TEST(SceneTableTest, a_ground_that_cannot_be_written_is_an_error) {
  const auto refused = scene_named("maunga-whau")->set_up("/nowhere/at/all");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("maunga-whau.ground"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace scree
