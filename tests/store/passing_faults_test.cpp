// Nothing that happens to a file and passes is the end of saving or recording: all of the world is saved
// afterwards, the recording goes on, and so does the next start.
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

#include "server/replay/verify.h"
#include "server/store/recorder.h"
#include "server/store/retry_pause.h"
#include "server/store/world_saver.h"
#include "tests/store/passing_fault.h"
#include "tests/store/world_file_fixture.h"
#include "tests/support/holds.h"

namespace scree {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds patience{30};

TEST(RetryPause, grows_to_a_bound_and_begins_small_again_after_a_long_time_without_failure) {
  RetryPause pause;
  EXPECT_TRUE(pause.is_over(0.0));
  double now_s = 100.0;
  std::vector<double> pauses;
  for (int i = 0; i < 9; ++i) {
    pause.failed(now_s, false);
    EXPECT_FALSE(pause.is_over(now_s));
    pauses.push_back(pause.next_s() - now_s);
    now_s = pause.next_s();
    EXPECT_TRUE(pause.is_over(now_s));
  }
  EXPECT_EQ(pauses, (std::vector<double>{0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 30.0, 30.0}));
  pause.failed(now_s, true);
  EXPECT_EQ(pause.next_s() - now_s, limits::retry_held_max_s);
  now_s += 10.0 * limits::retry_pause_max_s;
  pause.failed(now_s, false);
  EXPECT_EQ(pause.next_s() - now_s, limits::retry_pause_min_s);
}

class PassingFaultsOfWorlds : public WorldFileTest, public ::testing::WithParamInterface<Fault> {
 protected:
  void tick(WorldSaver& saver, bool carves) {
    std::vector<Command> commands;
    if (carves) ++carves_;
    if (carves) commands = {carve_at(static_cast<float>(carves_ % 8), carves_)};
    const auto delta = world->step(commands);
    if (saver.note(*delta)) saver.save(world->moment(), chunk_now(world->field()));
  }
  /// Ticks until it is so.
  template <typename Condition>
  bool ticks_until(WorldSaver& saver, const Condition& is_so) {
    const auto deadline = Clock::now() + patience;
    while (!is_so() && Clock::now() < deadline) {
      tick(saver, false);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return is_so();
  }

 private:
  uint32_t carves_ = 0;
};

TEST_P(PassingFaultsOfWorlds, all_is_saved_when_the_fault_has_passed) {
  FaultyDisk disk;
  make();
  WorldSaver saver(std::move(file), world->tick(), flat_terrain,
                   {.durability = Durability::tick, .before_save = {}});
  tick(saver, true);
  ASSERT_TRUE(ticks_until(saver, [&] { return saver.status().saved_tick > 30; }));
  PassingFault fault(GetParam(), disk, path);
  const Tick before = world->tick();
  for (int i = 0; i < 4; ++i) tick(saver, true);
  ASSERT_TRUE(ticks_until(saver, [&] { return saver.status().failures > 0; }));
  if (GetParam() != Fault::removed) {  // which mends itself
    EXPECT_LE(saver.status().saved_tick, before);
    EXPECT_FALSE(saver.status().health.ok());
    EXPECT_GT(saver.status().health.since_unix_ms, 0U);
  }
  fault.pass();
  tick(saver, true);
  const Tick last = world->tick();
  ASSERT_TRUE(ticks_until(saver, [&] { return saver.status().saved_tick >= last; }))
      << saver.status().health.because.value_or("");
  EXPECT_TRUE(saver.status().health.ok());
  EXPECT_EQ(refusal_of(path), "");
  tick(saver, true);
  ASSERT_TRUE(saver.finish(world->moment(), chunk_now(world->field())).has_value());
  EXPECT_EQ(value_in_file(), encode(world->snapshot()));
}

TEST_P(PassingFaultsOfWorlds, the_end_waits_for_a_fault_to_pass) {
  FaultyDisk disk;
  make();
  WorldSaver saver(std::move(file), world->tick(), flat_terrain,
                   {.durability = Durability::off, .autosave_s = 0.0, .before_save = {}});
  PassingFault fault(GetParam(), disk, path);
  for (int i = 0; i < 3; ++i) tick(saver, true);
  std::thread later([&] {
    while (saver.status().failures == 0) std::this_thread::yield();
    fault.pass();
  });
  const auto finished = saver.finish(world->moment(), chunk_now(world->field()));
  later.join();
  EXPECT_TRUE(finished.has_value()) << finished.error().message;
  EXPECT_EQ(value_in_file(), encode(world->snapshot()));
}

INSTANTIATE_TEST_SUITE_P(Each, PassingFaultsOfWorlds,
                         ::testing::Values(Fault::held, Fault::full, Fault::broken, Fault::read_only,
                                           Fault::removed),
                         name_of_fault);

TEST_F(WorldFileTest, a_file_in_the_place_of_one_that_was_moved_is_not_overwritten) {
  make();
  WorldSaver saver(std::move(file), world->tick(), flat_terrain,
                   {.durability = Durability::tick, .before_save = {}, .last_tries_s = 1.0});
  std::filesystem::rename(path, path + ".moved");
  write_file(path, {'l', 'e', 't', 't', 'e', 'r'});
  saver.note(*world->step(std::vector<Command>{carve_at(3.0F, 1)}));
  saver.save(world->moment());
  while (saver.status().failures == 0) std::this_thread::yield();
  const auto finished = saver.finish(world->moment());
  ASSERT_FALSE(finished.has_value());
  EXPECT_TRUE(holds(finished.error().message, "is another file than")) << finished.error().message;
  EXPECT_EQ(read_file(path).size(), 6U);
}

class RecordingPartsTest : public RecordingTest {
 protected:
  RecordingHeader header() const { return {"test", small_world()}; }
  void tick(Recorder& recorder) {
    std::vector<Command> commands;
    if (world.tick() % 30 == 9) commands = {carve_at(static_cast<float>(world.tick() % 7), 1)};
    recorder.push(world.step(commands), commands);
    if (!recorder.wants_start()) return;
    world.renew();
    recorder.begin_again({world.moment(), world.keyframe()});
  }
  void ticks(Recorder& recorder, int count) {
    for (int i = 0; i < count; ++i) tick(recorder);
  }
  /// The last tick of a part, which has to play from its beginning and verify. 0: it does not.
  static Tick verified(const std::string& part) {
    auto reader = RecordingReader::open(part);
    EXPECT_TRUE(reader.has_value()) << reader.error().message;
    if (!reader) return 0;
    const auto report = verify(**reader);
    EXPECT_TRUE(report && report->agrees()) << (report ? report->difference : report.error().message);
    return report && report->agrees() ? (*reader)->last_tick() : 0;
  }
  static Tick ticks_in(const std::string& part) {
    auto reader = RecordingReader::open(part);
    return reader ? (*reader)->last_tick() + 1 - (*reader)->first_tick() : 0;
  }
  static bool waits_for(const std::function<bool()>& is_so) {
    const auto deadline = Clock::now() + patience;
    while (!is_so() && Clock::now() < deadline) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return is_so();
  }

  World world{small_world()};
};

class PassingFaultsOfRecordings : public RecordingPartsTest, public ::testing::WithParamInterface<Fault> {};

TEST_P(PassingFaultsOfRecordings, the_recording_goes_on_and_so_does_the_next_start) {
  FaultyDisk disk;
  std::string last_part;
  uint64_t lost = 0;
  {
    auto opened = Recorder::open(path, header(), nullptr);
    ASSERT_TRUE(opened.has_value()) << opened.error().message;
    Recorder& recorder = **opened;
    ticks(recorder, 60);
    recorder.commit_up_to(60);
    PassingFault fault(GetParam(), disk, path);
    ticks(recorder, 30);
    recorder.commit_up_to(90);
    EXPECT_TRUE(waits_for([&] { return !recorder.health().ok(); }));
    fault.pass();
    const auto deadline = Clock::now() + patience;
    while (!recorder.health().ok() && Clock::now() < deadline) {
      tick(recorder);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_TRUE(recorder.health().ok()) << *recorder.health().because;
    ticks(recorder, 40);
    ASSERT_TRUE(recorder.finish().has_value());
    last_part = recorder.path();
    lost = recorder.health().lost;
  }
  const bool is_alone =
      GetParam() == Fault::held || GetParam() == Fault::removed;  // whose name is free again
  EXPECT_EQ(last_part, recording_part(path, is_alone ? 1 : 2));
  EXPECT_EQ(lost > 0, GetParam() != Fault::held);
  EXPECT_EQ(verified(last_part), world.tick());
  uint64_t recorded = ticks_in(last_part);
  if (last_part != path && GetParam() != Fault::removed) {
    EXPECT_GE(verified(path), 60U);
    recorded += ticks_in(path);
  }
  if (GetParam() != Fault::removed) {
    EXPECT_EQ(recorded + lost, world.tick());
  }

  world.renew();
  const RecordingStart from{world.moment(), world.keyframe()};
  auto again = Recorder::open(path, header(), &from);
  ASSERT_TRUE(again.has_value()) << again.error().message;
  ticks(**again, 20);
  ASSERT_TRUE((*again)->finish().has_value());
  EXPECT_EQ((*again)->path(), last_part);
  EXPECT_EQ(verified(last_part), world.tick());
}

INSTANTIATE_TEST_SUITE_P(Each, PassingFaultsOfRecordings,
                         ::testing::Values(Fault::held, Fault::full, Fault::broken, Fault::read_only,
                                           Fault::removed),
                         name_of_fault);

TEST_F(RecordingPartsTest,
       a_file_that_is_held_for_longer_than_ticks_can_wait_ends_a_part_and_nothing_waits_for_it) {
  auto opened = Recorder::open(path, header(), nullptr);
  ASSERT_TRUE(opened.has_value());
  Recorder& recorder = **opened;
  ticks(recorder, 10);
  recorder.commit_up_to(10);
  auto holder = Database::open(path);
  ASSERT_TRUE(holder && holder->execute("BEGIN EXCLUSIVE").has_value());
  ticks(recorder, 5);
  ASSERT_TRUE(waits_for([&] { return !recorder.health().ok(); }));
  ticks(recorder, static_cast<int>(limits::recorder_queue_max) + 100);
  EXPECT_GT(recorder.health().lost, 0U);
  ASSERT_TRUE(holder->execute("COMMIT").has_value());
  const auto deadline = Clock::now() + patience;
  while (!recorder.health().ok() && Clock::now() < deadline) {
    tick(recorder);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ticks(recorder, 10);
  ASSERT_TRUE(recorder.finish().has_value());
  EXPECT_EQ(recorder.path(), recording_part(path, 2));
  EXPECT_EQ(verified(path), 10 + limits::recorder_queue_max) << "all that waited";
  EXPECT_EQ(verified(recording_part(path, 2)), world.tick());
  EXPECT_EQ(ticks_in(path) + ticks_in(recording_part(path, 2)) + recorder.health().lost, world.tick());
}

TEST_F(RecordingPartsTest, a_start_goes_on_beside_a_recording_that_ended_before_its_world) {
  {
    auto recorder = Recorder::open(path, header(), nullptr);
    ASSERT_TRUE(recorder.has_value());
    ticks(**recorder, 30);
  }
  for (int tick = 0; tick < 20; ++tick) world.step({});
  world.renew();
  const RecordingStart from{world.moment(), world.keyframe()};
  {
    auto recorder = Recorder::open(path, header(), &from);
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    EXPECT_EQ((*recorder)->path(), recording_part(path, 2));
    ticks(**recorder, 10);
  }
  EXPECT_EQ(verified(path), 30U);
  EXPECT_EQ(verified(recording_part(path, 2)), 60U);
  EXPECT_EQ(recording_parts(path), (std::vector{path, recording_part(path, 2)}));
}

TEST_F(RecordingPartsTest,
       a_file_without_content_that_a_crash_left_keeps_no_start_back_and_foreign_files_do) {
  write_file(path, {});
  {
    auto recorder = Recorder::open(path, header(), nullptr);
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    EXPECT_EQ((*recorder)->path(), recording_part(path, 2));
  }
  write_file(path, {'d', 'e', 'a', 'r'});
  const auto foreign = Recorder::open(path, header(), nullptr);
  ASSERT_FALSE(foreign.has_value());
  EXPECT_TRUE(holds(foreign.error().message, "is no recording")) << foreign.error().message;
  const auto nowhere = Recorder::open((folder / "none" / "a.scree").string(), header(), nullptr);
  ASSERT_FALSE(nowhere.has_value());
  EXPECT_TRUE(holds(nowhere.error().message, "there is no folder")) << nowhere.error().message;
}

TEST_F(RecordingPartsTest, a_start_on_a_full_disk_records_once_there_is_room) {
  FaultyDisk disk;
  disk.full = true;
  auto recorder = Recorder::open(path, header(), nullptr);
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  ticks(**recorder, 5);
  EXPECT_FALSE((*recorder)->health().ok());
  disk.full = false;
  const auto deadline = Clock::now() + patience;
  while (!(*recorder)->health().ok() && Clock::now() < deadline) {
    tick(**recorder);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ticks(**recorder, 10);
  ASSERT_TRUE((*recorder)->finish().has_value());
  EXPECT_EQ(verified((*recorder)->path()), world.tick());
}

TEST_F(RecordingPartsTest, a_disk_that_hangs_holds_the_simulation_up_once_and_the_recording_goes_on) {
  FaultyDisk disk;
  auto recorder = Recorder::open(path, header(), nullptr);
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  ticks(**recorder, 60);
  (*recorder)->commit_up_to(60);
  disk.hangs = true;
  ticks(**recorder, 1);
  std::this_thread::sleep_for(std::chrono::duration<double>(2.0 * limits::seconds_per_commit));
  const auto begin = Clock::now();
  ticks(**recorder, static_cast<int>(limits::recorder_queue_max) + 200);
  const std::chrono::duration<double> took = Clock::now() - begin;
  const StoreHealth hanging = (*recorder)->health();
  disk.hangs = false;
  EXPECT_GE(took.count(), limits::recorder_patience_s) << "it did not hang";
  EXPECT_LT(took.count(), 3.0 * limits::recorder_patience_s);
  ASSERT_FALSE(hanging.ok());
  EXPECT_TRUE(holds(*hanging.because, "has not taken the recording")) << *hanging.because;
  EXPECT_GT(hanging.lost, 0U);
  const auto deadline = Clock::now() + patience;
  while (!(*recorder)->health().ok() && Clock::now() < deadline) {
    tick(**recorder);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ticks(**recorder, 40);
  ASSERT_TRUE((*recorder)->finish().has_value());
  EXPECT_GT(verified(path), 60U);
  EXPECT_EQ(verified((*recorder)->path()), world.tick());
}

TEST_F(RecordingPartsTest, a_part_that_begins_as_the_server_ends_has_its_last_ticks) {
  for (int round = 0; round < 5; ++round) {  // the thread may be faster
    const std::string named = path + std::to_string(round);
    FaultyDisk disk;
    disk.full = true;
    auto recorder = Recorder::open(named, header(), nullptr);
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    disk.full = false;
    ASSERT_TRUE(waits_for([&] { return (*recorder)->wants_start(); }));
    ticks(**recorder, 3);
    const auto finished = (*recorder)->finish();
    ASSERT_TRUE(finished.has_value()) << finished.error().message;
    EXPECT_EQ((*recorder)->health().lost, 1U) << "the tick before it";
    EXPECT_EQ(verified(named), world.tick());
  }
}

TEST_F(RecordingPartsTest, a_ring_that_is_whole_drops_older_parts_and_no_other_files) {
  {
    auto earlier = Recorder::open(path, header(), nullptr);
    ASSERT_TRUE(earlier.has_value()) << earlier.error().message;
    ticks(**earlier, 10);
  }
  for (int tick = 0; tick < 5; ++tick) world.step({});
  const std::string letter = recording_part(path, 2), ring = recording_part(path, 3);
  write_file(letter, {'d', 'e', 'a', 'r'});
  world.renew();
  const RecordingStart from{world.moment(), world.keyframe()};
  auto opened = Recorder::open(path, header(), &from, ring_limit_of("10s").value());
  ASSERT_TRUE(opened.has_value()) << opened.error().message;
  Recorder& recorder = **opened;
  EXPECT_EQ(recorder.path(), ring);
  for (int tick = 0; tick < 6000 && std::filesystem::exists(path); ++tick) {
    const auto delta = world.step({});
    std::shared_ptr<const WorldMoment> part;
    if (recorder.wants_part() != PartWish::none) {
      world.renew();
      part = std::make_shared<const WorldMoment>(world.moment());
    }
    recorder.push(delta, {}, {}, std::move(part));
    if (world.tick() % 15 == 0) recorder.commit_up_to(world.tick());
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(std::filesystem::exists(letter)) << "it is no recording";
  ASSERT_TRUE(recorder.finish().has_value());
  EXPECT_EQ(verified(ring), world.tick());
}

TEST(RecordingParts, are_named_beside_the_first_one) {
  EXPECT_EQ(recording_part("a/session.scree", 1), "a/session.scree");
  EXPECT_EQ(recording_part("a/session.scree", 12), "a/session-12.scree");
  EXPECT_EQ(recording_part("session", 2), "session-2");
}

}  // namespace
}  // namespace scree
