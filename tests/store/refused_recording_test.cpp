// Files that are no recordings, or damaged ones, are refused in words.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "server/formats/recording_codec.h"
#include "server/replay/replay_source.h"
#include "server/store/database.h"
#include "server/store/limits.h"
#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

TEST_F(RecordingTest, file_that_is_not_there_is_refused) {
  expect_refused("no such file");
}

TEST_F(RecordingTest, folder_is_refused) {
  path = folder.string();
  expect_refused("not a file");
}

TEST_F(RecordingTest, pipe_is_refused_and_not_waited_for) {
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  expect_refused("not a file");
}

TEST_F(RecordingTest, foreign_files_are_refused) {
  write_file(path, {});
  expect_refused("only 0 bytes");
  write_file(path, std::vector<char>(4096, 'x'));
  expect_refused("not an SQLite file");
}

TEST_F(RecordingTest, newer_and_foreign_sqlite_files_are_refused) {
  simulate(2);
  record();
  const std::vector<char> good = read_file(path);
  std::vector<char> newer = good;
  newer[63] = recording_format + 1;  // PRAGMA user_version (SQLite file format, 1.3)
  write_file(path, newer);
  expect_refused("format " + std::to_string(recording_format + 1));
  std::vector<char> foreign = good;
  foreign[68] = 0;  // PRAGMA application_id
  write_file(path, foreign);
  expect_refused("another program");
}

TEST_F(RecordingTest, sql_that_came_with_a_file_is_refused) {
  simulate(2);
  record();
  {
    auto database = Database::open(path);
    ASSERT_TRUE(database && database
                                ->execute("CREATE TRIGGER eats AFTER INSERT ON frames BEGIN DELETE FROM "
                                          "commands; END")
                                .has_value());
  }
  expect_refused("has a trigger \"eats\" that no recording has");
}

TEST_F(RecordingTest, a_world_beyond_its_limits_is_refused) {
  simulate(2);
  for (const auto& [voxel_size_m, tick_rate_hz, limit] :
       {std::tuple(0.05F, 60U, "voxel_size_min_m"),
        std::tuple(0.25F, 1U, "tick_rate_hz is 1, not within 10 to 1000")}) {
    WorldConfig config = small_world();
    config.terrain.voxel_size_m = voxel_size_m;
    config.tick_rate_hz = tick_rate_hz;
    fs::remove(path);
    record(config);
    expect_refused(limit);
  }
}

/// Every checksum is right: only the stamp itself says that no window holds it.
TEST_F(RecordingTest, a_stamp_of_a_window_beyond_all_bounds_is_refused_in_a_replay) {
  Volume volume;
  constexpr int side = limits::window_side_max;
  volume.window = Window(VoxelBox{{0, 0, 0}, {side, side, side}}, code_solid);
  volume.mass = mass_of(volume.window);
  volume.centre_voxels = glm::vec3(0.5F * side);
  const QuantisedPose turned = quantise({{}, {0.0F, 0.57735027F, 0.57735027F, 0.57735027F}});
  const Tick key = limits::ticks_per_keyframe;
  for (Tick tick = 1; tick <= key + 1; ++tick) {
    auto delta = std::make_shared<TickDelta>();
    delta->tick = tick;
    if (tick == 1) delta->spawned.push_back({7, std::make_shared<const Volume>(volume)});
    if (tick <= key) delta->pieces.push_back({7, turned});
    if (tick > key) delta->operations.push_back({StampOperation{7, turned, 0}, {}, {}, {}});
    deltas.push_back(std::move(delta));
    commands_by_tick.emplace_back();
  }
  record();
  auto source = ReplaySource::open(path, key);
  ASSERT_TRUE(source.has_value()) << source.error().message;
  ASSERT_TRUE((*source)->next().has_value()) << "the keyframe";
  const auto stamped = (*source)->next();
  ASSERT_FALSE(stamped.has_value());
  EXPECT_NE(stamped.error().message.find("stamp_voxels_max"), std::string::npos) << stamped.error().message;
}

TEST_F(RecordingTest, a_piece_that_is_made_twice_is_refused_in_a_replay) {
  simulate(10);
  auto again = std::make_shared<TickDelta>(*deltas.back());
  again->operations = deltas[9]->operations;
  ++again->tick;
  deltas.push_back(again);
  commands_by_tick.emplace_back();
  record();
  auto source = ReplaySource::open(path);
  ASSERT_TRUE(source.has_value()) << source.error().message;
  for (int tick = 1; tick <= 10; ++tick) ASSERT_TRUE((*source)->next().has_value()) << tick;
  const auto twice = (*source)->next();
  ASSERT_FALSE(twice.has_value());
  EXPECT_NE(twice.error().message.find("is alive already"), std::string::npos) << twice.error().message;
}

TEST_F(RecordingTest, recording_without_a_tick_is_refused) {
  record();
  expect_refused("no tick");
}

TEST_F(RecordingTest, recording_with_missing_ticks_is_refused) {
  simulate(6);
  record();
  const std::vector<char> good = read_file(path);
  for (const char* missing : {"tick = 1", "tick = 4", "tick BETWEEN 2 AND 5"}) {
    SCOPED_TRACE(missing);
    write_file(path, good);
    {
      auto database = Database::open(path);
      ASSERT_TRUE(database.has_value()) << database.error().message;
      ASSERT_TRUE(database->execute(std::string("DELETE FROM frames WHERE ") + missing).has_value());
    }
    expect_refused("ticks are missing");
  }
}

TEST_F(RecordingTest, ticks_before_the_first_one_are_refused) {
  simulate(2);
  record();
  {
    auto database = Database::open(path);
    ASSERT_TRUE(database.has_value()) << database.error().message;
    ASSERT_TRUE(database
                    ->execute("UPDATE frames SET tick = -9223372036854775807 - 1 WHERE tick = 1;"
                              "UPDATE frames SET tick = 9223372036854775807 WHERE tick = 2")
                    .has_value());
  }
  expect_refused("it begins at tick -9223372036854775808");
}

TEST_F(RecordingTest, data_that_is_not_what_its_checksum_says_is_refused) {
  simulate(6);
  record();
  {
    auto database = Database::open(path);
    ASSERT_TRUE(database.has_value()) << database.error().message;
    ASSERT_TRUE(database->execute("UPDATE frames SET checksum = checksum + 1 WHERE tick = 4").has_value());
  }
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_TRUE((*reader)->frame(3).has_value());
  const auto frame = (*reader)->frame(4);
  ASSERT_FALSE(frame.has_value());
  EXPECT_NE(frame.error().message.find("row 4 is not what was written"), std::string::npos)
      << frame.error().message;
}

TEST_F(RecordingTest, keyframe_whose_hash_is_not_what_was_recorded_is_refused) {
  constexpr Tick tick = limits::ticks_per_keyframe;
  simulate(tick);
  record();
  std::vector<uint8_t> wrong;
  {
    auto reader = RecordingReader::open(path);
    ASSERT_TRUE(reader.has_value()) << reader.error().message;
    auto keyframe = (*reader)->keyframe_before(tick);
    ASSERT_TRUE(keyframe.has_value() && keyframe->has_value());
    (*keyframe)->field_hash ^= 1U;
    (*keyframe)->bricks.clear();  // they are rows of their own, as the pieces are
    (*keyframe)->pieces.clear();
    wrong = encode(**keyframe);
  }
  put_recorded("keyframe_states", tick, wrong);
  const auto source = ReplaySource::open(path, tick);
  ASSERT_FALSE(source.has_value());
  EXPECT_NE(source.error().message.find("hash"), std::string::npos) << source.error().message;
}

TEST_F(RecordingTest, file_cut_short_anywhere_is_refused) {
  simulate(60);
  record();
  const std::vector<char> good = read_file(path);
  for (size_t size = 1; size < good.size(); size += good.size() / 23) {
    write_file(path, {good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_FALSE(refusal().empty()) << size << " of " << good.size() << " bytes";
  }
}

TEST_F(RecordingTest, damaged_bytes_never_crash_and_never_pass_as_another_tick) {
  simulate(12);
  record();
  const std::vector<char> good = read_file(path);
  Random random(11);
  for (int round = 0; round < 40; ++round) {
    std::vector<char> bad = good;
    for (int i = 0; i < 4; ++i)
      bad[random.below(static_cast<uint32_t>(bad.size()))] ^= static_cast<char>(1 + random.below(255));
    write_file(path, bad);
    fs::remove(path + "-wal");
    auto source = ReplaySource::open(path);
    if (!source) continue;
    for (const auto& published : deltas) {
      const auto played = (*source)->next();
      if (!played || !*played) break;
      ASSERT_EQ((*played)->tick, published->tick);
      ASSERT_EQ((*played)->field_hash, published->field_hash);
    }
  }
}

}  // namespace
}  // namespace scree
