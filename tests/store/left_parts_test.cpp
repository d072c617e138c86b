// A recording or a world that is copied after its server ended is whole: each part that was given up is one
// file at the end, or the log names the file that belongs to it.
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

#include "server/replay/verify.h"
#include "server/store/recorder.h"
#include "server/store/world_saver.h"
#include "tests/store/passing_fault.h"
#include "tests/store/world_file_fixture.h"
#include "tests/support/captured_log.h"
#include "tests/support/holds.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

class LeftPartsTest : public RecordingTest {
 protected:
  std::unique_ptr<Recorder> start(const RecordingStart* from = nullptr) {
    auto opened = Recorder::open(path, {"test", small_world()}, from);
    EXPECT_TRUE(opened.has_value()) << opened.error().message;
    return opened ? std::move(*opened) : nullptr;
  }
  void ticks(Recorder& recorder, int count) {
    for (int i = 0; i < count; ++i) {
      std::vector<Command> commands;
      if (world.tick() % 30 == 9) commands = {carve_at(static_cast<float>(world.tick() % 7), 1)};
      recorder.push(world.step(commands), commands);
      if (!recorder.wants_start()) continue;
      world.renew();
      recorder.begin_again({world.moment(), world.keyframe()});
    }
  }
  void ticks_until_it_is_written(Recorder& recorder) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!recorder.health().ok() && std::chrono::steady_clock::now() < deadline) {
      ticks(recorder, 1);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_TRUE(recorder.health().ok());
  }
  /// A part of which the last ticks lie in its log, because the disk is full.
  void give_up(Recorder& recorder, FaultyDisk& disk) {
    ticks(recorder, 60);
    recorder.commit_up_to(60);
    disk.full = true;
    ticks(recorder, 30);
    recorder.commit_up_to(90);
    EXPECT_FALSE(recorder.health().ok());
  }
  /// The last tick of a copy of this file alone; 0: it is not whole.
  Tick last_tick_of_copy(const std::string& part) const {
    const std::string copy = (folder / "copy").string();
    fs::copy_file(part, copy, fs::copy_options::overwrite_existing);
    const auto reader = RecordingReader::open(copy);
    EXPECT_TRUE(reader.has_value()) << reader.error().message;
    if (!reader) return 0;
    EXPECT_TRUE((*reader)->is_ended());
    EXPECT_FALSE((*reader)->may_lack_ticks());
    const auto report = verify(**reader);
    EXPECT_TRUE(report && report->agrees());
    return (*reader)->last_tick();
  }
  bool has_logs() const {
    for (const auto& file : fs::directory_iterator(folder))
      if (file.path().string().ends_with("-wal")) return true;
    return false;
  }

  World world{small_world()};
};

class LeftPartsAfter : public LeftPartsTest, public ::testing::WithParamInterface<Fault> {};

TEST_P(LeftPartsAfter, each_part_is_one_whole_file_at_a_clean_end) {
  FaultyDisk disk;
  const auto recorder = start();
  ticks(*recorder, 60);
  recorder->commit_up_to(60);
  PassingFault fault(GetParam(), disk, path);
  ticks(*recorder, 30);
  recorder->commit_up_to(90);
  EXPECT_FALSE(recorder->health().ok());
  fault.pass();
  ticks_until_it_is_written(*recorder);
  ticks(*recorder, 40);
  CapturedLog log;
  ASSERT_TRUE(recorder->finish().has_value());
  EXPECT_EQ(recorder->path(), recording_part(path, 2));
  EXPECT_FALSE(has_logs());
  EXPECT_GE(last_tick_of_copy(path), 60U);
  EXPECT_EQ(last_tick_of_copy(recording_part(path, 2)), world.tick());
  EXPECT_EQ(log.text(), "");
}

INSTANTIATE_TEST_SUITE_P(Each, LeftPartsAfter,
                         ::testing::Values(Fault::full, Fault::broken, Fault::read_only), name_of_fault);

TEST_F(LeftPartsTest, a_log_that_stays_is_named_and_the_next_session_closes_that_part) {
  FaultyDisk disk;
  {
    const auto recorder = start();
    give_up(*recorder, disk);
    CapturedLog log;
    EXPECT_FALSE(recorder->finish(0.0).has_value());
    ASSERT_TRUE(fs::exists(path + "-wal"));
    EXPECT_EQ(log.count(path + "-wal is left"), 1U) << log.text();
  }
  disk.full = false;
  world.renew();
  const RecordingStart from{world.moment(), world.keyframe()};
  CapturedLog log;
  const auto again = start(&from);
  EXPECT_EQ(again->path(), recording_part(path, 2));
  EXPECT_TRUE(holds(log.text(), "the session is recorded to " + recording_part(path, 2))) << log.text();
  EXPECT_FALSE(holds(log.text(), "choose another name")) << log.text();
  ticks(*again, 10);
  ASSERT_TRUE(again->finish().has_value());
  EXPECT_FALSE(has_logs());
  EXPECT_EQ(last_tick_of_copy(path), 60U);
}

TEST_F(LeftPartsTest, a_recording_that_somebody_reads_at_the_end_has_its_log_named) {
  const auto recorder = start();
  ticks(*recorder, 30);
  recorder->commit_up_to(30);
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  CapturedLog log;
  ASSERT_TRUE(recorder->finish().has_value());
  EXPECT_EQ(log.count(path + "-wal is left"), 1U) << log.text();
  EXPECT_TRUE(holds(log.text(), "another program holds the file")) << log.text();
}

TEST_F(LeftPartsTest, a_file_of_somebody_else_with_the_name_of_a_part_is_let_be) {
  const std::string letter = recording_part(path, 2);
  write_file(letter, {'d', 'e', 'a', 'r'});
  write_file(letter + "-wal", {'m', 'e'});
  {
    const auto recorder = start();
    ticks(*recorder, 10);
    ASSERT_TRUE(recorder->finish().has_value());
  }
  EXPECT_EQ(read_file(letter).size(), 4U);
  EXPECT_EQ(read_file(letter + "-wal").size(), 2U);
}

TEST_F(LeftPartsTest, a_session_of_which_nothing_was_recorded_says_so) {
  FaultyDisk disk;
  {
    const auto recorder = start();
    give_up(*recorder, disk);
    EXPECT_FALSE(recorder->finish(0.0).has_value());
  }
  world.renew();
  const RecordingStart from{world.moment(), world.keyframe()};
  CapturedLog log;
  const auto again = start(&from);
  ticks(*again, 7);
  const auto finished = again->finish(0.0);
  ASSERT_FALSE(finished.has_value());
  const std::string& said = finished.error().message;
  EXPECT_TRUE(holds(said, "nothing of this session is recorded")) << said;
  EXPECT_TRUE(holds(said, "7 ticks are in no part")) << said;
  EXPECT_TRUE(holds(said, "the disk is full")) << said;
  EXPECT_FALSE(holds(said, "after 0")) << said;
  EXPECT_FALSE(holds(log.text(), "choose another name")) << log.text();
}

TEST_F(WorldFileTest, a_world_is_one_whole_file_at_its_end_also_while_others_have_it_open) {
  make();
  WorldSaver saver(std::move(file), world->tick(), flat_terrain,
                   {.durability = Durability::tick, .before_save = {}});
  const auto reader = WorldFile::open(path);
  ASSERT_TRUE(reader && (*reader)->read_moment());
  saver.note(*world->step(std::vector<Command>{carve_at(3.0F, 1)}));
  ASSERT_TRUE(saver.finish(world->moment(), chunk_now(world->field())).has_value());
  const std::string copy = folder / "copy.world";
  fs::copy_file(path, copy);
  path = copy;
  EXPECT_EQ(value_in_file(), encode(world->snapshot()));
}

/// A world that nobody touches, and whose file cannot be written at its end.
class UntouchedWorld : public WorldFileTest, public ::testing::WithParamInterface<Fault> {};

TEST_P(UntouchedWorld, loses_nothing_and_an_edit_is_a_loss) {
  for (const bool carves : {false, true}) {
    SCOPED_TRACE(carves);
    FaultyDisk disk;
    world = std::make_unique<World>(small_world());
    world->step({});  // which says all settings
    path = folder / (carves ? "carved.world" : "untouched.world");
    auto made = WorldFile::create(path, header_of(world->snapshot()), world->snapshot());
    ASSERT_TRUE(made.has_value()) << made.error().message;
    WorldSaver saver(
        std::move(*made), world->tick(), flat_terrain,
        {.durability = Durability::off, .autosave_s = 0.0, .before_save = {}, .last_tries_s = 0.5});
    PassingFault fault(GetParam(), disk, path);
    std::vector<Command> commands;
    if (carves) commands = {carve_at(3.0F, 1)};
    saver.note(*world->step(commands));
    saver.note(*world->step({}));
    const auto finished = saver.finish(world->moment(), chunk_now(world->field()));
    EXPECT_EQ(finished.has_value(), !carves) << finished.error().message;
    EXPECT_FALSE(saver.status().health.ok()) << "the report has it";
    EXPECT_EQ(saver.status().saved_tick, 1U);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, UntouchedWorld, ::testing::Values(Fault::held, Fault::full, Fault::read_only),
                         name_of_fault);

TEST_F(WorldFileTest, a_world_whose_file_is_gone_is_lost_also_where_nobody_touched_it) {
  FaultyDisk disk;
  world = std::make_unique<World>(small_world());
  world->step({});
  auto made = WorldFile::create(path, header_of(world->snapshot()), world->snapshot());
  ASSERT_TRUE(made.has_value()) << made.error().message;
  WorldSaver saver(
      std::move(*made), world->tick(), flat_terrain,
      {.durability = Durability::off, .autosave_s = 0.0, .before_save = {}, .last_tries_s = 0.1});
  fs::remove(path);
  disk.full = true;  // so that it cannot be put back
  saver.note(*world->step({}));
  EXPECT_FALSE(saver.finish(world->moment()).has_value());
}

TEST_F(WorldFileTest, errors_name_their_reason_in_words_and_no_statements) {
  FaultyDisk disk;
  const auto words_of = [](const auto& result) { return result ? std::string() : result.error().message; };
  auto database = Database::create(path);
  ASSERT_TRUE(database && database->execute("CREATE TABLE letters (a)"));
  const auto write = [&] { return words_of(database->execute("INSERT INTO letters VALUES (1)")); };
  disk.full = true;
  EXPECT_EQ(write(), path + ": cannot be written: the disk is full");
  disk.full = false;
  disk.broken = true;
  EXPECT_TRUE(write().starts_with(path + ": cannot be written: the disk fails"));
  disk.broken = false;
  {
    auto holder = Database::open(path);
    ASSERT_TRUE(holder && holder->execute("BEGIN EXCLUSIVE"));
    database->wait_at_most(std::chrono::milliseconds(1));
    EXPECT_EQ(write(), path + ": cannot be written: another program holds the file");
    EXPECT_TRUE(Database::is_held({write()}));
  }
  fs::rename(path, path + ".moved");
  EXPECT_EQ(write(), path + ": cannot be written: the file was moved or removed");
  disk.full = true;
  const std::string full = words_of(Database::create(path).and_then(
      [](Database anew) { return anew.execute("PRAGMA page_size = 4096; CREATE TABLE letters (a)"); }));
  EXPECT_EQ(full, path + ": cannot be written: the disk is full");
  EXPECT_TRUE(Database::is_refusal({full}) && Database::may_pass({full}));
}

}  // namespace
}  // namespace scree
