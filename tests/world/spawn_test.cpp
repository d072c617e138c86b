// Where visitors begin: on every ground outside rock, with ground and sky in sight; chosen, saved, recorded,
// and lifted out of terrain that was filled over it.
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "server/app/saved_world.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/recorder.h"
#include "server/store/stored_field.h"
#include "server/world/overlook.h"
#include "server/world/recorded_values.h"
#include "server/world/settings.h"
#include "server/world/spawn_place.h"
#include "tests/support/flat_world.h"
#include "tests/support/memory_heights.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

constexpr float sight_m = 90.0F;
const Spawn chosen{{3.0F, 2.0F, -4.0F}, 30.0F, -10.0F};

Command set_spawn(const std::string& value) {
  return {1, 7, SettingsRequest{{{std::string(spawn_setting), value}}}};
}

/// The shares of a coarse picture from the spawn, of a vertical field of view of 60 degrees.
struct Shares {
  int sky = 0, all = 0;
  float nearest_m = sight_m;
};

Shares shares_of(const Field& field, const Spawn& spawn) {
  constexpr float radians = 0.01745329F, tangent = 0.577F, aspect = 16.0F / 9.0F;
  const float yaw = spawn.yaw_degrees * radians, pitch = spawn.pitch_degrees * radians;
  const glm::vec3 ahead(-std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch));
  const glm::vec3 right = glm::normalize(glm::cross(ahead, {0.0F, 1.0F, 0.0F})),
                  up = glm::cross(right, ahead);
  const float voxel_m = field.source().voxel_size_m;
  Shares shares;
  for (int y = -4; y <= 4; ++y)
    for (int x = -8; x <= 8; ++x, ++shares.all) {
      const glm::vec3 ray = glm::normalize(ahead + right * (tangent * aspect * static_cast<float>(x) / 8.0F) +
                                           up * (tangent * static_cast<float>(y) / 4.0F));
      const auto hit = trace(field, spawn.eye_m / voxel_m, ray, sight_m / voxel_m);
      if (!hit) ++shares.sky;
      if (hit) shares.nearest_m = std::min(shares.nearest_m, *hit * voxel_m);
    }
  return shares;
}

void expect_a_good_place(const TerrainSource& source) {
  const MapField field(source);
  const Spawn spawn = lifted(field, overlook_of(source));
  SCOPED_TRACE(text_of(spawn));
  EXPECT_EQ(spawn, lifted(field, spawn)) << "no rock is there";
  const float ground_m = ground_height_m(source, spawn.eye_m.x, spawn.eye_m.z);
  EXPECT_GT(spawn.eye_m.y, ground_m + 2.0F);
  EXPECT_LT(spawn.eye_m.y, ground_m + 12.0F);
  EXPECT_LT(std::max(std::abs(spawn.eye_m.x), std::abs(spawn.eye_m.z)), 100.0F);
  const Shares shares = shares_of(field, spawn);
  EXPECT_GT(shares.sky, shares.all / 10) << "the horizon is in the picture";
  EXPECT_LT(shares.sky, shares.all * 6 / 10) << "and so is the ground";
  EXPECT_GT(shares.nearest_m, 1.5F);
}

TEST(Spawn, every_generated_ground_suggests_a_place_with_ground_and_sky_in_sight) {
  for (const TerrainKind kind : all_kinds<TerrainKind>)
    for (const uint32_t seed : {1U, 2U, 3U, 77U, 4000000000U})
      for (const float voxel_m : {0.25F, 1.0F}) {
        SCOPED_TRACE(std::string(name_of(kind)) + " " + std::to_string(seed) + " " + std::to_string(voxel_m));
        expect_a_good_place({kind, seed, voxel_m});
      }
}

TEST(Spawn, a_ground_by_heights_suggests_one_too) {
  for (const float steep : {0.0F, 0.3F, 1.5F}) {
    SCOPED_TRACE(steep);
    const auto hills = [steep](int x, int z) {
      const float wave = std::sin(0.21F * static_cast<float>(x)) * std::cos(0.17F * static_cast<float>(z));
      return static_cast<int32_t>(40.0F * steep * wave * static_cast<float>(height_steps_per_m) / 2.0F);
    };
    expect_a_good_place({.heights = std::make_shared<MemoryHeights>(64, 48, 2.0F, hills)});
  }
}

TEST(Spawn, a_text_says_a_place_or_is_refused) {
  EXPECT_EQ(parse_spawn("3,2,-4,30,-10"), chosen);
  EXPECT_EQ(parse_spawn(text_of(chosen)), chosen);
  EXPECT_EQ(parse_spawn("1,2.5,-3"), (Spawn{{1.0F, 2.5F, -3.0F}, 0.0F, 0.0F}));
  EXPECT_EQ(parse_spawn("0,0,0,350,0")->yaw_degrees, -10.0F);
  for (const char* text :
       {"", "1", "1,2", "1,2,3,4", "1,2,3,4,5,6", "1,2,3,", "1,2,3,4,5,", "a,2,3", "1 ,2,3", "nan,0,0",
        "inf,0,0", "0,0,0,nan,0", "4097,0,0", "0,513,0", "0,0,0,0,89.5"})
    EXPECT_FALSE(parse_spawn(text)) << text;
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
