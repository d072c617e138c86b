// Worlds on the ground of a file, kept and recorded: files name the ground by its hash, it is found again,
// and another one is refused. Worlds out of recordings.
#include <gtest/gtest.h>

#include "ground/ground_search.h"
#include "server/app/ground_giver.h"
#include "server/app/live_server.h"
#include "server/app/recorded_past.h"
#include "server/app/saved_world.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/ground_mass.h"
#include "server/store/recorder.h"
#include "tests/support/test_folder.h"
#include "tests/support/written_ground.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

class SavedGroundTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ::setenv("XDG_DATA_HOME", (folder / "data").c_str(), 1);
    written_ground(ground, 40, 30, 2.0F);
    config.terrain.voxel_size_m = 0.25F;
    const auto taken = set_ground(ground, config);
    ASSERT_TRUE(taken.has_value()) << taken.error().message;
    config.pieces_max = 100;
  }
  void TearDown() override { ::unsetenv("XDG_DATA_HOME"); }

  /// Opens the world, steps it, and saves and records every tick, as a server does. The error, if any.
  std::string play(Tick ticks, const WorldConfig& asked) {
    auto saved_world = SavedWorld::open(world, asked, 1, ground_giver(world, asked));
    if (!saved_world) return saved_world.error().message;
    auto live = (*saved_world)->release_world();
    const RecordingHeader header{"test", live->config()};
    auto recorder = live->tick() == 0
                        ? Recorder::create(recording, header)
                        : Recorder::create(recording, header, {live->moment(), live->keyframe()});
    if (!recorder) return recorder.error().message;
    if (auto begun = (*saved_world)->start(*live, {.durability = Durability::off, .before_save = {}}); !begun)
      return begun.error().message;
    for (const Tick end = live->tick() + ticks; live->tick() < end;) {
      std::vector<Command> commands;
      if (live->tick() % 15 == 2) commands = {carve(static_cast<float>(live->tick() / 15))};
      const auto delta = live->step(commands);
      (*saved_world)->note(*delta, *live);
      (*recorder)->push(delta, commands);
    }
    if (auto done = (*recorder)->finish(); !done) return done.error().message;
    if (auto done = (*saved_world)->finish(*live); !done) return done.error().message;
    return {};
  }
  Command carve(float x_m) const {
    CarveRequest carve;
    const float y_m = ground_height_m(config.terrain, x_m, 0.0F);
    carve.shape = sphere({x_m, y_m, 0.0F}, 1.0F);
    carve.seeds = 5;
    carve.random_seed = 7;
    carve.impact_m = {x_m, y_m, 0.0F};
    return {1, 1, carve};
  }
  std::string verified(uint64_t restarts) const {
    auto reader = RecordingReader::open(recording);
    if (!reader) return reader.error().message;
    const auto report = verify(**reader, {}, ground_giver(recording, WorldConfig()));
    if (!report) return report.error().message;
    EXPECT_EQ(report->restarts, restarts);
    return report->difference;
  }
  std::optional<WorldRows> rows_of(const std::string& path) const {
    const auto file = WorldFile::open(path);
    auto rows = file ? (*file)->read() : tl::unexpected(file.error());
    EXPECT_TRUE(rows.has_value()) << rows.error().message;
    if (!rows) return std::nullopt;
    return std::move(*rows);
  }
  void expect_named(const std::string& said, const std::vector<std::string>& words) const {
    for (const std::string& word : words) EXPECT_NE(said.find(word), std::string::npos) << said;
  }

  TestFolder folder;
  std::string ground = folder / "hills.ground", world = folder / "a.world", recording = folder / "a.scree";
  WorldConfig config;
};

TEST_F(SavedGroundTest, a_world_on_a_ground_goes_on_and_its_recording_verifies) {
  ASSERT_EQ(play(30, config), "");
  ASSERT_EQ(play(30, WorldConfig()), "") << "the ground is found beside the world";
  const auto rows = rows_of(world);
  ASSERT_TRUE(rows.has_value());
  EXPECT_EQ(rows->world.moment.config.ground, config.ground);
  EXPECT_EQ(rows->header.config.ground, config.ground);
  EXPECT_EQ(rows->world.moment.tick, 60U);
  EXPECT_GT(rows->chunks.size(), 2U);
  EXPECT_EQ(verified(1), "");
  auto source = ReplaySource::open(recording, 0, ground_giver(recording, WorldConfig()));
  ASSERT_TRUE(source.has_value()) << source.error().message;
  EXPECT_NE((*source)->header().world.terrain.heights, nullptr);
  ASSERT_TRUE((*source)->seek(60).has_value());
  EXPECT_EQ((*(*source)->next())->field_hash, rows->world.moment.field_hash);
}

TEST_F(SavedGroundTest, a_ground_that_is_not_there_and_another_one_are_named) {
  ASSERT_EQ(play(5, config), "");
  const std::string hash = hex_of(config.ground);
  fs::create_directories(folder / "data/scree/grounds");
  const std::string other = folder / "data/scree/grounds/other.ground";
  WorldConfig others;
  written_ground(other, 30, 30, 2.0F);
  ASSERT_TRUE(set_ground(other, others).has_value());
  expect_named(play(5, others), {world, hash, hex_of(others.ground), "--ground"});

  fs::rename(ground, folder / "hills.gone");
  expect_named(play(5, WorldConfig()), {world, hash, folder / "data/scree/grounds", "--ground"});
  expect_named(verified(0), {recording, hash, "--ground"});
  auto source = ReplaySource::open(recording);
  ASSERT_FALSE(source.has_value());
  expect_named(source.error().message, {recording, hash});
  auto reader = RecordingReader::open(recording);
  ASSERT_TRUE(reader.has_value()) << "what it holds is said without the ground";
  EXPECT_EQ((*reader)->header().world.ground, config.ground);

  fs::copy_file(folder / "hills.gone", folder / "data/scree/grounds/any name.ground");
  EXPECT_EQ(play(5, WorldConfig()), "") << "the folder of all grounds";
  fs::remove(folder / "data/scree/grounds/any name.ground");
  EXPECT_EQ(play(5, config), "") << "the ground of the command line, wherever it lies";
}

TEST_F(SavedGroundTest, a_damaged_ground_is_named_and_a_world_without_a_ground_has_none) {
  ASSERT_EQ(play(5, config), "");
  fs::resize_file(ground, fs::file_size(ground) - 20);
  expect_named(play(5, WorldConfig()), {ground, "cut short"});
  const auto none = find_ground(config.ground, {folder / "no folder"});
  ASSERT_FALSE(none.has_value());
  expect_named(none.error().message, {folder / "no folder", hex_of(config.ground)});
}

TEST_F(SavedGroundTest, a_server_keeps_and_replays_it_and_refuses_a_ground_for_generated_terrain) {
  LiveConfig live;
  live.net.port = 0;
  live.pacing = Pacing::by_hand;
  live.world = config;
  live.world_path = world;
  live.record_path = recording;
  const auto run = [&](int ticks) -> std::string {
    auto server = LiveServer::start(live);
    if (!server) return server.error().message;
    while (ticks-- > 0 && (*server)->step_once()) {
    }
    const auto stopped = (*server)->stop();
    return stopped ? std::string() : stopped.error().message;
  };
  ASSERT_EQ(run(5), "");
  live.world = WorldConfig();
  ASSERT_EQ(run(5), "");
  EXPECT_EQ(verified(1), "");
  ASSERT_TRUE(roll_back(world, recording, 0, ground_giver(world, WorldConfig())).has_value());
  ASSERT_EQ(run(7), "") << "the recording goes on from tick 0, too";
  EXPECT_EQ(verified(1), "");
  live.world_path = live.record_path = "";
  live.replay.path = recording;
  EXPECT_EQ(run(100), "");

  live.replay.path = "";
  live.world_path = folder / "canyon.world";
  ASSERT_EQ(run(1), "");
  live.world = config;
  expect_named(run(1), {live.world_path, "generated", hex_of(config.ground), "--ground"});
}

TEST_F(SavedGroundTest, rows_say_what_the_ground_weighs_and_a_start_takes_it_from_them) {
  ASSERT_EQ(play(40, config), "");
  const auto rows = rows_of(world);
  ASSERT_TRUE(rows.has_value());
  EXPECT_EQ(rows->ground, measured_ground(config.terrain, rows->world.bricks));
  EXPECT_EQ(rows->ground.size(), rows->chunks.size());
  WorldSnapshot value = rows->world;
  value.moment.config.terrain = config.terrain;
  EXPECT_TRUE(World::restore(value, 1, rows->ground).has_value());
  GroundMasses lies = rows->ground;
  ++lies.begin()->second;
  const auto refused = World::restore(value, 1, lies);
  ASSERT_FALSE(refused.has_value());
  expect_named(refused.error().message, {"mass of its terrain"});
  lies.erase(lies.begin());
  EXPECT_TRUE(World::restore(value, 1, lies).has_value()) << "what is not known is measured";
}

TEST_F(SavedGroundTest, a_world_is_made_of_any_tick_of_a_recording) {
  ASSERT_EQ(play(30, config), "");
  ASSERT_EQ(play(30, config), "");
  auto reader = RecordingReader::open(recording);
  ASSERT_TRUE(reader.has_value());
  const auto giver = ground_giver(recording, WorldConfig());
  for (const Tick tick : {0U, 7U, 30U, 44U, 60U}) {
    const std::string path = folder / ("past " + std::to_string(tick));
    const auto made = world_of_recording(path, recording, tick, giver);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    const auto rows = rows_of(path);
    ASSERT_TRUE(rows.has_value());
    EXPECT_EQ(rows->world.moment.tick, tick);
    if (tick == 0) continue;
    const auto frame = (*reader)->frame(tick);
    EXPECT_EQ(rows->world.moment.state_hash, frame->state_hash);
  }
  const auto last = world_of_recording(folder / "last", recording, std::nullopt, giver);
  ASSERT_TRUE(last.has_value()) << last.error().message;
  EXPECT_EQ(last->tick, 60U);
  const auto beyond = world_of_recording(folder / "beyond", recording, 61, giver);
  ASSERT_FALSE(beyond.has_value());
  expect_named(beyond.error().message, {recording, "0 to 60", "61"});
  EXPECT_FALSE(fs::exists(folder / "beyond"));
  EXPECT_FALSE(world_of_recording(folder / "last", recording, 1, giver).has_value()) << "it exists";
}

TEST_F(SavedGroundTest, a_world_rolled_back_goes_on_from_there_and_so_does_its_recording) {
  ASSERT_EQ(play(60, config), "");
  const auto giver = ground_giver(world, WorldConfig());
  const auto before = rows_of(world);
  const auto rolled = roll_back(world, recording, 20, giver);
  ASSERT_TRUE(rolled.has_value()) << rolled.error().message;
  const auto rows = rows_of(world), saved_world = rows_of(rolled->before);
  ASSERT_TRUE(before && rows && saved_world);
  EXPECT_EQ(rows->world.moment.tick, 20U);
  EXPECT_EQ(rows->header.world, before->header.world);
  EXPECT_EQ(saved_world->world.moment.state_hash, before->world.moment.state_hash);
  ASSERT_EQ(play(25, WorldConfig()), "");
  EXPECT_EQ(verified(1), "");
  EXPECT_EQ(rows_of(world)->world.moment.tick, 45U);
  const auto twice = roll_back(world, recording, 20, giver);
  ASSERT_FALSE(twice.has_value());
  expect_named(twice.error().message, {rolled->before, "exists already"});
}

TEST_F(SavedGroundTest, a_world_is_not_rolled_back_to_another_ones_past) {
  ASSERT_EQ(play(20, config), "");
  const std::string mine = std::exchange(recording, folder / "b.scree");
  const std::string first = std::exchange(world, folder / "b.world");
  ASSERT_EQ(play(10, config), "");  // the same ground, but not as long
  fs::rename(recording, folder / "c.scree");
  ASSERT_EQ(play(20, config), "");
  const auto refused = roll_back(first, recording, 12, ground_giver(first, WorldConfig()));
  ASSERT_FALSE(refused.has_value());
  expect_named(refused.error().message, {"of another world", first});
  EXPECT_EQ(rows_of(first)->world.moment.tick, 20U);
}

}  // namespace
}  // namespace scree
