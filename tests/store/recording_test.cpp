// Recordings: what is recorded plays back as it was, verifies, survives a crash, and a file that is none is
// refused in words.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/database.h"
#include "server/store/limits.h"
#include "server/store/recorder.h"
#include "server/store/recording_writer.h"
#include "server/world/world.h"
#include "shared/base/limits.h"
#include "shared/base/random.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

WorldConfig small_world() {
  WorldConfig config;
  config.terrain = {TerrainKind::flat, 1, 0.25F};
  config.pieces_max = 100;
  return config;
}

Command carve_at(float x_m, uint32_t request) {
  CarveRequest carve;
  carve.shape = sphere({x_m, 0.0F, 0.0F}, 1.0F);
  carve.seeds = 6;
  carve.random_seed = request;
  carve.impact_m = {x_m, 1.0F, 0.0F};
  return {1, request, carve};
}

std::vector<char> read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_file(const fs::path& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

class RecordingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() /
             ("scree_recording_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    path = (folder / "session.scree").string();
  }
  void TearDown() override { fs::remove_all(folder); }

  /// Simulates `ticks` ticks with a carve now and then; keeps what was published.
  void simulate(Tick ticks) {
    World world(small_world());
    for (Tick tick = 1; tick <= ticks; ++tick) {
      std::vector<Command> commands;
      if (tick % 100 == 10)
        commands = {carve_at(static_cast<float>(tick % 7), static_cast<uint32_t>(tick)),
                    {2, 1, FillRequest{sphere({-8.0F, 1.0F, 0.0F}, 1.0F)}}};
      deltas.push_back(world.step(commands));
      commands_by_tick.push_back(std::move(commands));
    }
  }
  void record(const WorldConfig& config = small_world()) {
    auto recorder = Recorder::create(path, {"test", config});
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    for (size_t i = 0; i < deltas.size(); ++i) (*recorder)->push(deltas[i], commands_by_tick[i]);
    const auto finished = (*recorder)->finish();
    ASSERT_TRUE(finished.has_value()) << finished.error().message;
  }
  std::string refusal() const {
    auto reader = RecordingReader::open(path);
    return reader ? std::string() : reader.error().message;
  }
  void expect_refused(const std::string& because) const {
    const std::string reason = refusal();
    EXPECT_NE(reason.find(because), std::string::npos) << reason;
    EXPECT_NE(reason.find(path), std::string::npos) << reason;
  }

  fs::path folder;
  std::string path;
  std::vector<std::shared_ptr<const TickDelta>> deltas;
  std::vector<std::vector<Command>> commands_by_tick;
};

/// Everything that a viewer or a publisher can see.
void expect_same(const TickDelta& a, const TickDelta& b) {
  ASSERT_EQ(a.tick, b.tick);
  ASSERT_EQ(a.operations.size(), b.operations.size());
  for (size_t i = 0; i < a.operations.size(); ++i) {
    EXPECT_EQ(a.operations[i].operation, b.operations[i].operation);
    EXPECT_EQ(a.operations[i].reads, b.operations[i].reads);
    EXPECT_EQ(a.operations[i].writes, b.operations[i].writes);
    EXPECT_EQ(a.operations[i].created, b.operations[i].created);
  }
  ASSERT_EQ(a.bricks.size(), b.bricks.size());
  for (size_t i = 0; i < a.bricks.size(); ++i) {
    EXPECT_EQ(a.bricks[i].coord, b.bricks[i].coord);
    EXPECT_EQ(a.bricks[i].hash, b.bricks[i].hash);
  }
  ASSERT_EQ(a.spawned.size(), b.spawned.size());
  for (size_t i = 0; i < a.spawned.size(); ++i) {
    EXPECT_EQ(a.spawned[i].id, b.spawned[i].id);
    EXPECT_EQ(a.spawned[i].volume->window.codes, b.spawned[i].volume->window.codes);
  }
  EXPECT_EQ(a.pieces, b.pieces);
  EXPECT_EQ(a.ledger, b.ledger);
  EXPECT_EQ(a.field_hash, b.field_hash);
  EXPECT_EQ(a.state_hash, b.state_hash);
}

TEST_F(RecordingTest, replay_gives_every_tick_as_it_was_published) {
  simulate(400);
  record();
  auto source = ReplaySource::open(path);
  ASSERT_TRUE(source.has_value()) << source.error().message;
  EXPECT_EQ((*source)->header().world, small_world());
  for (const auto& published : deltas) {
    const auto played = (*source)->next();
    ASSERT_TRUE(played.has_value()) << played.error().message;
    ASSERT_NE(*played, nullptr);
    expect_same(**played, *published);
    if (HasFailure()) return;
  }
  const auto end = (*source)->next();
  ASSERT_TRUE(end.has_value());
  EXPECT_EQ(*end, nullptr);
}

TEST_F(RecordingTest, seek_by_keyframe_gives_the_state_and_goes_on) {
  simulate(2 * limits::ticks_per_keyframe + 50);
  record();
  for (const Tick from : {Tick{5}, limits::ticks_per_keyframe, limits::ticks_per_keyframe + 37}) {
    auto source = ReplaySource::open(path, from);
    ASSERT_TRUE(source.has_value()) << source.error().message;
    const auto whole = (*source)->next();
    ASSERT_TRUE(whole.has_value());
    PublishedState played;
    played.apply(**whole);
    EXPECT_EQ(played.tick(), from);
    EXPECT_EQ(played.field_hash(), deltas[from - 1]->field_hash);
    EXPECT_EQ(played.pieces().size(), deltas[from - 1]->pieces.size());
    const auto next = (*source)->next();
    ASSERT_TRUE(next.has_value()) << next.error().message;
    expect_same(**next, *deltas[from]);
  }
}

TEST_F(RecordingTest, seek_past_the_end_is_refused) {
  simulate(3);
  record();
  const auto source = ReplaySource::open(path, 4);
  ASSERT_FALSE(source.has_value());
  EXPECT_NE(source.error().message.find("after its end, 3"), std::string::npos) << source.error().message;
}

TEST_F(RecordingTest, verify_agrees_twice_in_one_process) {
  simulate(300);
  record();
  for (int i = 0; i < 2; ++i) {
    auto reader = RecordingReader::open(path);
    ASSERT_TRUE(reader.has_value()) << reader.error().message;
    const auto report = verify(**reader);
    ASSERT_TRUE(report.has_value()) << report.error().message;
    EXPECT_TRUE(report->agrees()) << report->first_difference << ": " << report->difference;
    EXPECT_EQ(report->ticks, 300U);
    EXPECT_EQ(report->commands, 6U);
  }
}

TEST_F(RecordingTest, verify_names_the_first_tick_that_differs) {
  simulate(60);
  commands_by_tick[9].pop_back();  // a recording that lost a command
  record();
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value());
  const auto report = verify(**reader);
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->first_difference, 10U);
  EXPECT_NE(report->difference.find("field_hash"), std::string::npos) << report->difference;
}

TEST_F(RecordingTest, replay_names_a_tick_whose_hash_is_not_what_was_recorded) {
  simulate(20);
  auto wrong = std::make_shared<TickDelta>(*deltas[14]);
  wrong->field_hash ^= 1U;
  deltas[14] = wrong;
  record();
  auto source = ReplaySource::open(path);
  ASSERT_TRUE(source.has_value());
  for (int i = 0; i < 14; ++i) ASSERT_TRUE((*source)->next().has_value());
  const auto next = (*source)->next();
  ASSERT_FALSE(next.has_value());
  EXPECT_NE(next.error().message.find("tick 15"), std::string::npos) << next.error().message;
}

TEST_F(RecordingTest, what_was_committed_before_a_crash_plays) {
  simulate(50);
  auto writer = RecordingWriter::create(path, {"test", small_world()});
  ASSERT_TRUE(writer.has_value());
  for (size_t i = 0; i < 40; ++i) ASSERT_TRUE((*writer)->add(*deltas[i], commands_by_tick[i]).has_value());
  ASSERT_TRUE((*writer)->commit().has_value());
  for (size_t i = 40; i < 50; ++i) ASSERT_TRUE((*writer)->add(*deltas[i], commands_by_tick[i]).has_value());
  // The machine's view at the crash: the files as they lie there, without the last transaction.
  const fs::path crashed = folder / "crashed.scree";
  fs::copy_file(path, crashed);
  fs::copy_file(path + "-wal", crashed.string() + "-wal");
  auto source = ReplaySource::open(crashed.string());
  ASSERT_TRUE(source.has_value()) << source.error().message;
  EXPECT_EQ((*source)->last_tick(), 40U);
  for (int i = 0; i < 40; ++i) ASSERT_TRUE((*source)->next().has_value());
}

TEST_F(RecordingTest, recording_over_an_existing_file_is_refused) {
  write_file(path, {'d', 'e', 'a', 'r'});
  const auto recorder = Recorder::create(path, {"test", small_world()});
  ASSERT_FALSE(recorder.has_value());
  EXPECT_NE(recorder.error().message.find("exists already"), std::string::npos);
  EXPECT_EQ(read_file(path).size(), 4U);
}

TEST_F(RecordingTest, recording_where_nothing_can_be_written_is_refused) {
  const auto recorder = Recorder::create((folder / "none" / "a.scree").string(), {"test", small_world()});
  ASSERT_FALSE(recorder.has_value());
  EXPECT_NE(recorder.error().message.find("cannot be created"), std::string::npos)
      << recorder.error().message;
}

TEST_F(RecordingTest, file_that_is_not_there_is_refused) {
  expect_refused("no such file");
}

TEST_F(RecordingTest, folder_is_refused) {
  path = folder.string();
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
  newer[63] = 9;  // PRAGMA user_version (SQLite file format, 1.3)
  write_file(path, newer);
  expect_refused("format 9");
  std::vector<char> foreign = good;
  foreign[68] = 0;  // PRAGMA application_id
  write_file(path, foreign);
  expect_refused("another program");
}

TEST_F(RecordingTest, a_world_beyond_its_limits_is_refused) {
  simulate(2);
  for (const auto& [voxel_size_m, tick_rate_hz, limit] :
       {std::tuple(0.05F, 60U, "voxel_size_min_m"), std::tuple(0.25F, 1U, "tick_rate_min_hz")}) {
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
  EXPECT_NE(twice.error().message.find("made a second time"), std::string::npos) << twice.error().message;
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
  EXPECT_NE(frame.error().message.find("tick 4 is not what was recorded"), std::string::npos)
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
    wrong = encode(**keyframe);
  }
  {
    auto database = Database::open(path);
    ASSERT_TRUE(database.has_value()) << database.error().message;
    const auto replace =
        database->prepare("REPLACE INTO keyframes (tick, data, checksum) VALUES (?1, ?2, ?3)");
    ASSERT_TRUE(replace.has_value() && database->put(*replace, tick, wrong).has_value());
  }
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
