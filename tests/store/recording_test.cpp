// Recordings: what is recorded plays back as it was, verifies, and survives a crash.
#include <chrono>
#include <csignal>
#include <future>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "server/formats/world_codec.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/limits.h"
#include "server/store/recording_writer.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

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

TEST_F(RecordingTest, a_copy_without_its_log_says_what_is_missing) {
  simulate(20);
  auto writer = RecordingWriter::create(path, {"test", small_world()});
  ASSERT_TRUE(writer.has_value());
  for (size_t i = 0; i < 20; ++i) ASSERT_TRUE((*writer)->add(*deltas[i], commands_by_tick[i]).has_value());
  ASSERT_TRUE((*writer)->commit().has_value());
  const std::string copy = (folder / "copy.scree").string();
  fs::copy_file(path, copy);
  const auto reader = RecordingReader::open(copy);
  ASSERT_FALSE(reader.has_value());
  EXPECT_NE(reader.error().message.find(copy + "-wal is missing"), std::string::npos)
      << reader.error().message;
  fs::copy_file(path + "-wal", copy + "-wal", fs::copy_options::overwrite_existing);
  EXPECT_TRUE(RecordingReader::open(copy).has_value());
}

TEST_F(RecordingTest, another_kind_of_file_lacks_no_log) {
  auto database = Database::create(path);
  ASSERT_TRUE(database.has_value());
  ASSERT_TRUE(
      database->execute("PRAGMA journal_mode = WAL; PRAGMA application_id = 1396920919; CREATE TABLE t (a)"));
  ASSERT_TRUE(database->execute("PRAGMA wal_checkpoint"));
  const std::string copy = (folder / "copy.world").string();
  fs::copy_file(path, copy);
  const auto reader = RecordingReader::open(copy);
  ASSERT_FALSE(reader.has_value());
  EXPECT_NE(reader.error().message.find("is no recording"), std::string::npos) << reader.error().message;
  EXPECT_EQ(reader.error().message.find("-wal"), std::string::npos) << reader.error().message;
}

TEST_F(RecordingTest,
       a_file_over_its_limit_is_an_error_with_its_reason_and_leaves_nothing_that_was_not_begun) {
  simulate(200);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto bound = [&](rlim_t bytes) {
    const rlimit small{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  };
  bound(8192);
  const auto none = RecordingWriter::create(path, {"test", small_world()});
  bound(before.rlim_cur);
  ASSERT_FALSE(none.has_value());
  EXPECT_NE(none.error().message.find("File too large"), std::string::npos) << none.error().message;
  EXPECT_TRUE(fs::is_empty(folder));
  auto recorder = Recorder::create(path, {"test", small_world()});
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  bound(fs::file_size(path + "-wal") + 300'000);
  for (size_t i = 0; i < deltas.size() && (*recorder)->health().ok(); ++i) {
    (*recorder)->push(deltas[i], commands_by_tick[i]);
    if (i % 10 == 9) (*recorder)->commit_up_to(deltas[i]->tick);
  }
  const auto finished = (*recorder)->finish(0.0);
  bound(before.rlim_cur);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(finished.has_value());
  EXPECT_NE(finished.error().message.find("File too large"), std::string::npos) << finished.error().message;
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_GE((*reader)->last_tick(), 10U);
  EXPECT_TRUE(verify(**reader)->agrees());
}

TEST_F(RecordingTest, what_is_being_written_reads_as_it_stands_and_says_that_it_has_not_ended) {
  simulate(15);
  auto writer = RecordingWriter::create(path, {"test", small_world()});
  ASSERT_TRUE(writer.has_value());
  const auto add = [&](size_t from, size_t to) {
    for (size_t i = from; i < to; ++i)
      ASSERT_TRUE((*writer)->add(*deltas[i], commands_by_tick[i]).has_value());
    ASSERT_TRUE((*writer)->commit().has_value());
  };
  add(0, 10);
  const auto before = RecordingReader::open(path);
  ASSERT_TRUE(before.has_value()) << before.error().message;
  add(10, 15);
  EXPECT_EQ((*before)->last_tick(), 10U);
  const auto after = RecordingReader::open(path);
  ASSERT_TRUE(after.has_value()) << after.error().message;
  EXPECT_EQ((*after)->last_tick(), 15U);
  EXPECT_FALSE((*after)->is_ended());
  EXPECT_GT((*after)->bytes(), fs::file_size(path)) << "most of it lies in the log beside the file";
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
  record();
  auto frame = recorded_frame(15);
  frame.field_hash ^= 1U;
  put_recorded("frames", 15, encode(frame));
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

TEST_F(RecordingTest, a_tick_whose_commands_cannot_be_written_is_no_part_of_the_recording) {
  simulate(10);
  ASSERT_FALSE(commands_by_tick[9].empty());
  auto writer = RecordingWriter::create(path, {"test", small_world()});
  ASSERT_TRUE(writer.has_value());
  for (size_t i = 0; i < 9; ++i) ASSERT_TRUE((*writer)->add(*deltas[i], commands_by_tick[i]).has_value());
  ASSERT_TRUE((*writer)->commit().has_value());
  {
    auto other = Database::open(path);
    ASSERT_TRUE(other && other->execute("INSERT INTO commands VALUES (10, x'00', 0)").has_value());
  }
  EXPECT_FALSE((*writer)->add(*deltas[9], commands_by_tick[9]).has_value());
  ASSERT_TRUE((*writer)->finish().has_value());
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_EQ((*reader)->last_tick(), 9U);
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

/// A world that is carved at that place in tick 3.
std::unique_ptr<World> carved_world(float x_m, Tick ticks, Recorder* recorder) {
  auto world = std::make_unique<World>(small_world());
  for (Tick tick = 1; tick <= ticks; ++tick) {
    std::vector<Command> commands;
    if (tick == 3) commands = {carve_at(x_m, 1)};
    const auto delta = world->step(commands);
    if (recorder != nullptr) recorder->push(delta, commands);
  }
  return world;
}

RecordingStart start_of(World& world) {
  return {world.moment(), world.keyframe()};
}

TEST_F(RecordingTest, goes_on_with_the_world_that_it_is_of_and_with_no_other) {
  const RecordingHeader header{"test", small_world()};
  {
    auto recorder = Recorder::create(path, header);
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    carved_world(0.0F, 10, recorder->get());
  }
  {
    auto saved = World::restore(carved_world(0.0F, 8, nullptr)->snapshot());
    ASSERT_TRUE(saved.has_value()) << saved.error().message;
    auto recorder = Recorder::create(path, header, start_of(**saved));
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    for (int tick = 9; tick <= 12; ++tick) (*recorder)->push((*saved)->step({}), {});
  }
  const auto another = Recorder::create(path, header, start_of(*carved_world(2.0F, 8, nullptr)));
  ASSERT_FALSE(another.has_value());
  EXPECT_NE(another.error().message.find("another world"), std::string::npos) << another.error().message;
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_EQ((*reader)->last_tick(), 12U);
  const auto report = verify(**reader);
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_TRUE(report->agrees()) << report->first_difference << ": " << report->difference;
}

TEST_F(RecordingTest, verify_refuses_a_state_that_is_of_another_tick) {
  {
    const auto world = carved_world(0.0F, 5, nullptr);
    auto recorder = Recorder::create(path, {"test", small_world()}, start_of(*world));
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    (*recorder)->push(world->step({}), {});
  }
  put_recorded("state_moments", 5, encode(WorldSnapshot{carved_world(0.0F, 3, nullptr)->moment(), {}}));
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  const auto report = verify(**reader);
  ASSERT_FALSE(report.has_value());
  EXPECT_NE(report.error().message.find("says that it is of tick 3"), std::string::npos)
      << report.error().message;
}

TEST_F(RecordingTest, the_tick_that_a_recording_begins_from_is_committed_before_any_other) {
  const auto world = carved_world(0.0F, 5, nullptr);
  auto recorder = Recorder::create(path, {"test", small_world()}, start_of(*world));
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  auto waiting = std::async(std::launch::async, [&] { (*recorder)->commit_up_to(world->tick()); });
  EXPECT_EQ(waiting.wait_for(std::chrono::seconds(20)), std::future_status::ready);
  ASSERT_TRUE((*recorder)->finish().has_value());  // ends the waiting in any case
}

TEST_F(RecordingTest, verify_agrees_on_what_was_dropped_when_a_session_left) {
  WorldConfig config = small_world();
  config.pieces_max = 4000;
  World world(config);
  size_t dropped = 0;
  for (Tick tick = 1; tick <= 120; ++tick) {
    std::vector<Command> commands;
    for (uint32_t i = 0; tick == 1 && i < 24; ++i) {
      Command command = carve_at(static_cast<float>(i) - 12.0F, i);
      command.session = 3 + i % 2;
      std::get<CarveRequest>(command.body).shape = sphere({static_cast<float>(i) - 12.0F, 0.0F, 0.0F}, 2.0F);
      std::get<CarveRequest>(command.body).seeds = 64;
      commands.push_back(command);
    }
    if (tick == 3) commands = {{3, 0, LeaveRequest{}}};
    deltas.push_back(world.step(commands));
    for (const Reply& reply : deltas.back()->replies)
      dropped += reply.reason == Refusal::session_over ? 1 : 0;
    commands_by_tick.push_back(std::move(commands));
  }
  EXPECT_GT(dropped, 0U);
  record(config);
  const auto agrees = [&] {
    auto reader = RecordingReader::open(path);
    const auto report = reader ? verify(**reader) : tl::unexpected(reader.error());
    EXPECT_TRUE(report) << report.error().message;
    return report && report->agrees();
  };
  EXPECT_TRUE(agrees());
  commands_by_tick[2].clear();
  path = (folder / "without.scree").string();
  record(config);
  EXPECT_FALSE(agrees()) << "it is a part of the commands";
}

}  // namespace
}  // namespace scree
