// Where visitors begin: chosen, saved, recorded, and lifted out of terrain that was filled over it.
#include <gtest/gtest.h>

#include "server/app/saved_world.h"
#include "server/field/vdb_field.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/recorder.h"
#include "server/store/stored_field.h"
#include "server/world/recorded_values.h"
#include "server/world/settings.h"
#include "server/world/spawn_place.h"
#include "tests/support/flat_world.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

const Spawn chosen{{3.0F, 2.0F, -4.0F}, 30.0F, -10.0F};

Command set_spawn(const std::string& value) {
  return {1, 7, SettingsRequest{{{std::string(spawn_setting), value}}}};
}

TEST(Spawn, is_a_setting_that_changes_no_hash) {
  World world(flat_world()), other(flat_world());
  const Spawn suggested = *world.keyframe().spawn;
  const std::vector<Command> set{set_spawn(text_of(chosen))}, back{set_spawn("auto")},
      wrong{set_spawn("up there")};
  const auto delta = world.step(set);
  EXPECT_EQ(delta->replies.front().refusal, "");
  EXPECT_EQ(delta->spawn, chosen);
  EXPECT_EQ(delta->state_hash, other.step({})->state_hash);
  EXPECT_EQ(world.config().spawn, chosen);
  EXPECT_FALSE(world.step({})->spawn.has_value()) << "it stays";
  EXPECT_NE(world.step(wrong)->replies.front().refusal.find("is auto or X,Y,Z"), std::string::npos);
  EXPECT_EQ(world.keyframe().spawn, chosen);
  EXPECT_EQ(world.step(back)->spawn, suggested);
}

TEST(Spawn, who_would_begin_in_rock_is_lifted_out_of_it) {
  WorldConfig config = flat_world();
  config.spawn = chosen;
  World world(config);
  ASSERT_EQ(world.keyframe().spawn, chosen);
  const glm::vec3 at_m = chosen.eye_m;
  const std::vector<Command> far{{1, 1, FillRequest{box({40.0F, 2.0F, 0.0F}, glm::vec3(2.0F))}}};
  EXPECT_FALSE(world.step(far)->spawn.has_value()) << "elsewhere";
  const std::vector<Command> over{{1, 2, FillRequest{box(at_m, {4.0F, 3.0F, 4.0F})}}};
  const auto filled = world.step(over);
  ASSERT_TRUE(filled->spawn.has_value());
  EXPECT_GT(filled->spawn->eye_m.y, at_m.y + 3.0F);
  EXPECT_LT(filled->spawn->eye_m.y, at_m.y + 6.0F);
  EXPECT_EQ(filled->spawn->yaw_degrees, chosen.yaw_degrees);
  EXPECT_EQ(world.keyframe().spawn, filled->spawn);
  CarveRequest dig;
  dig.shape = sphere(at_m + glm::vec3(0.0F, 1.0F, 0.0F), 3.5F);
  dig.seeds = 1;
  dig.impact_m = at_m;
  const std::vector<Command> carve{{1, 3, dig}};
  EXPECT_EQ(world.step(carve)->spawn, chosen) << "somebody dug it free again";
}

TEST(Spawn, follows_the_terrain_when_a_replay_jumps) {
  VdbField filled(flat_terrain), before(flat_terrain);
  PieceTable pieces;
  const Applied over = apply(FillOperation{box(chosen.eye_m, glm::vec3(3.0F))}, filled, pieces);
  SpawnPlace place;
  EXPECT_GT(place.find(filled, chosen).eye_m.y, chosen.eye_m.y);
  TickDelta jump;
  jump.reverted = over.changed;
  place.follow(before, chosen, jump);
  EXPECT_EQ(jump.spawn, chosen);
}

TEST(Spawn, is_saved_with_its_world) {
  const TestFolder folder;
  const std::string path = folder / "kept.world";
  WorldConfig config = flat_world();
  config.spawn = chosen;
  {
    World world(config);
    const WorldHeader header{.world = 7, .config = world.moment().config};
    ASSERT_TRUE(create_world(path, header, world));
  }
  const auto saved = SavedWorld::open(path, flat_world(), 1, {});
  ASSERT_TRUE(saved) << saved.error().message;
  const auto world = (*saved)->release_world();
  EXPECT_EQ(world->config().spawn, chosen);
  EXPECT_EQ(world->keyframe().spawn, chosen);
}

TEST(Spawn, a_recording_has_it_and_verifies_and_a_replay_follows_it) {
  const TestFolder folder;
  const std::string path = folder / "moved.scree";
  WorldConfig config = flat_world();
  config.spawn = chosen;
  const Spawn later{{-8.0F, 5.0F, 6.0F}, 90.0F, 0.0F};
  auto recorder = Recorder::create(path, {"test", config});
  ASSERT_TRUE(recorder) << recorder.error().message;
  World world(config);
  for (Tick tick = 1; tick <= 40; ++tick) {
    std::vector<Command> commands;
    if (tick == 20) commands.push_back(set_spawn(text_of(later)));
    (*recorder)->push(world.step(commands), commands);
  }
  ASSERT_TRUE((*recorder)->finish());
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ((*reader)->header().world, config);
  const auto report = verify(**reader);
  ASSERT_TRUE(report && report->agrees()) << report->difference;
  auto source = ReplaySource::open(path);
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ((*source)->spawn(), chosen);
  std::optional<Spawn> told;
  for (Tick tick = 1; tick <= 40; ++tick)
    if (const auto delta = (*source)->next(); delta && *delta && (*delta)->spawn) told = (*delta)->spawn;
  EXPECT_EQ(told, later);
  const auto back = (*source)->jump(5);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ((*back)->spawn, chosen);
}

/// Older programs refuse a setting of a header that they do not know.
TEST(Spawn, the_header_of_a_file_has_it_apart_from_the_settings_that_older_programs_read) {
  WorldConfig config = flat_world();
  config.spawn = chosen;
  const RecordedHeader header = to_recorded(config);
  for (const SettingValue& setting : header.settings) EXPECT_NE(setting.name, spawn_setting);
  const auto read = decode_recorded_header(encode(header));
  ASSERT_TRUE(read) << read.error().message;
  const auto config_read = config_of(*read);
  ASSERT_TRUE(config_read) << config_read.error().message;
  EXPECT_EQ(*config_read, config);
}

}  // namespace
}  // namespace scree
