// The log of events: what follows from the simulation is recorded and verified, what does not is kept apart;
// a reader has both without simulating; files of them outlive a full disk.
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include "server/formats/event_codec.h"
#include "server/replay/export_lines.h"
#include "server/replay/verify.h"
#include "server/store/event_deriver.h"
#include "server/store/event_lines.h"
#include "server/store/event_log.h"
#include "server/store/limits.h"
#include "server/store/recording_writer.h"
#include "tests/support/holds.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

class EventsTest : public RecordingTest {
 protected:
  /// With events of the machine at two ticks.
  void record_with_sessions() {
    auto recorder = Recorder::create(path, {"test", small_world()});
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    for (size_t i = 0; i < deltas.size(); ++i) {
      std::vector<Event> noted;
      if (i == 4)
        noted = {
            {.kind = EventKind::join, .tick = 5, .place_m = glm::vec3(1, 2, 3), .session = 7, .text = "Ann"}};
      if (i == 99) noted = {{.kind = EventKind::leave, .tick = 100, .session = 7, .text = "Ann"}};
      (*recorder)->push(deltas[i], commands_by_tick[i], noted);
    }
    ASSERT_TRUE((*recorder)->finish().has_value());
  }
  std::vector<Event> recorded_events() const {
    const auto reader = RecordingReader::open(path);
    if (!reader) return {};
    auto events = (*reader)->events((*reader)->first_tick(), (*reader)->last_tick());
    EXPECT_TRUE(events.has_value()) << events.error().message;
    return events ? *events : std::vector<Event>();
  }
  std::vector<std::string> exported(LineFormat format) const {
    std::vector<std::string> lines;
    const auto done =
        export_events(path, {}, format, [&](const std::string& line) { lines.push_back(line); });
    EXPECT_TRUE(done.has_value()) << done.error().message;
    return lines;
  }
  VerifyReport verified() const {
    const auto reader = RecordingReader::open(path);
    EXPECT_TRUE(reader.has_value());
    const auto report = verify(**reader);
    EXPECT_TRUE(report.has_value()) << report.error().message;
    return *report;
  }
};

TEST_F(EventsTest, a_recording_has_every_carve_and_fill_with_tick_place_and_size) {
  simulate(150);
  record();
  const std::vector<Event> events = recorded_events();
  ASSERT_GE(events.size(), 4U);
  // Two clients ask in one tick: whose turn is first depends on what each costs.
  const bool carve_first = events[0].kind == EventKind::carve;
  const Event &carve = events[carve_first ? 0 : 1], &fill = events[carve_first ? 1 : 0];
  EXPECT_EQ(carve.kind, EventKind::carve);
  EXPECT_EQ(carve.tick, 10U);
  EXPECT_EQ(carve.place_m, glm::vec3(3.0F, 0.0F, 0.0F));
  const auto carved = std::ranges::find_if(deltas[9]->operations, [](const AppliedOperation& applied) {
    return std::holds_alternative<CarveOperation>(applied.operation);
  });
  ASSERT_NE(carved, deltas[9]->operations.end());
  EXPECT_EQ(carve.pieces, carved->created.size());
  EXPECT_GT(carve.volume_m3, 0.5F);
  EXPECT_LT(carve.volume_m3, 4.2F) << "more than the sphere";
  EXPECT_EQ(fill.kind, EventKind::fill);
  EXPECT_EQ(fill.place_m, glm::vec3(-8.0F, 1.0F, 0.0F));
}

/// A tick in which so many pieces merge at that place.
TickDelta merging(Tick tick, uint32_t pieces, float x_m) {
  TickDelta delta;
  delta.tick = tick;
  StampOperation stamp;
  stamp.pose = quantise({.position_m = {x_m, 0.0F, 0.0F}});
  stamp.others.resize(pieces - 1);
  delta.operations.push_back({stamp, {}, {}, {}});
  return delta;
}

TEST(EventDeriver, merges_near_each_other_within_a_second_are_one_event) {
  EventDeriver deriver(0.25F, {});
  std::vector<Event> events;
  for (Tick tick = 1; tick <= 200; ++tick) {
    TickDelta delta;
    delta.tick = tick;
    if (tick <= 40) delta = merging(tick, 2, 5.0F);   // a burst
    if (tick == 20) delta = merging(tick, 9, 50.0F);  // another one, elsewhere
    if (tick == 100) delta = merging(tick, 3, 5.0F);  // too few
    for (const Event& event : deriver.events_of(delta)) events.push_back(event);
  }
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EventKind::merge);
  EXPECT_EQ(events[0].tick, 1 + merge_burst_ticks);
  EXPECT_EQ(events[0].pieces, 78U);
  EXPECT_EQ(events[0].place_m, glm::vec3(5.0F, 0.0F, 0.0F));
  EXPECT_EQ(events[1].tick, 20 + merge_burst_ticks);
  EXPECT_EQ(events[1].pieces, 9U);
}

TEST(EventDeriver, a_carve_is_told_as_what_made_it_and_later_cuts_of_one_are_not_told) {
  const auto told = [](const Operation& operation, TickStage stage) {
    TickDelta delta;
    delta.tick = 1;
    AppliedOperation applied;
    applied.operation = operation;
    applied.stage = stage;
    delta.operations.push_back(applied);
    std::vector<EventKind> kinds;
    for (const Event& event : EventDeriver(0.25F, {}).events_of(delta)) kinds.push_back(event.kind);
    return kinds;
  };
  const CarveOperation carve{.shape = sphere({}, 1.0F)};
  EXPECT_EQ(told(carve, TickStage::requests), std::vector{EventKind::carve});
  EXPECT_EQ(told(carve, TickStage::impacts), std::vector{EventKind::dent});
  EXPECT_EQ(told(carve, TickStage::support), std::vector{EventKind::crush});
  EXPECT_EQ(told(ShatterOperation{}, TickStage::impacts), std::vector{EventKind::broke});
  EXPECT_TRUE(told(ShatterOperation{}, TickStage::refracture).empty());
}

TEST(EventDeriver, the_place_of_an_edit_is_the_middle_of_its_shape) {
  const Shape box{ShapeKind::box, {-37.0F, -1.5F, 4.0F}, {1.6F, 1.6F, 2.0F}, 0.25F};
  const Shape capsule{ShapeKind::capsule, {2.0F, 0.0F, 0.0F}, {4.0F, 2.0F, 0.0F}, 0.5F};
  const auto place = [](const Operation& operation) {
    TickDelta delta;
    delta.tick = 1;
    delta.operations.push_back({operation, {}, {}, {}});
    return EventDeriver(0.25F, {}).events_of(delta).front().place_m;
  };
  EXPECT_EQ(place(CarveOperation{.shape = box}), box.a);
  EXPECT_EQ(place(FillOperation{.shape = box}), box.a);
  EXPECT_EQ(place(CarveOperation{.shape = capsule}), glm::vec3(3.0F, 1.0F, 0.0F));
}

TEST_F(EventsTest, a_change_of_settings_is_an_event_and_the_first_tick_is_none) {
  World world(small_world());
  for (Tick tick = 1; tick <= 5; ++tick) {
    std::vector<Command> commands;
    if (tick == 3) commands = {{1, 1, SettingsRequest{{{"impacts", "false"}}}}};
    deltas.push_back(world.step(commands));
    commands_by_tick.push_back(commands);
  }
  record();
  const std::vector<Event> events = recorded_events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0], (Event{.kind = EventKind::setting, .tick = 3, .session = 1, .text = "impacts=false"}));
  EXPECT_TRUE(verified().agrees());
}

TEST_F(EventsTest, verify_compares_the_worlds_events_and_leaves_the_machines_alone) {
  simulate(150);
  record_with_sessions();
  const VerifyReport report = verified();
  EXPECT_TRUE(report.agrees()) << report.difference;
  EXPECT_EQ(report.events, recorded_events().size());
  std::vector<Event> events = {recorded_events().front()};
  events[0].volume_m3 += 1.0F;
  put_recorded("events", 10, encode(std::span<const Event>(events)));
  EXPECT_EQ(verified().first_difference, 10U);
  EXPECT_TRUE(holds(verified().difference, "events")) << verified().difference;
}

TEST_F(EventsTest, events_of_the_machine_keep_their_tick_and_durations_cover_every_tick) {
  simulate(150);
  record_with_sessions();
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value());
  EXPECT_EQ((*reader)->events_from(), 1U);
  const auto rows = (*reader)->machine(1, 150);
  ASSERT_TRUE(rows.has_value()) << rows.error().message;
  size_t ticks = 0;
  std::vector<Event> events;
  for (const RecordedMachine& row : *rows) {
    ticks += row.tick_us.size();
    EXPECT_EQ(row.tick, ticks);
    events.insert(events.end(), row.events.begin(), row.events.end());
  }
  EXPECT_EQ(ticks, 150U);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EventKind::join);
  EXPECT_EQ(events[0].tick, 5U);
  EXPECT_EQ(events[0].text, "Ann");
  EXPECT_EQ(events[1].tick, 100U);
}

TEST_F(EventsTest, export_writes_the_events_in_order_as_json_lines_and_as_csv) {
  simulate(120);
  record_with_sessions();
  const auto lines = exported(LineFormat::jsonl);
  ASSERT_GE(lines.size(), 4U);
  Tick before = 0;
  for (const std::string& line : lines) {
    const auto json = nlohmann::json::parse(line);
    EXPECT_GE(json["tick"].get<Tick>(), before);
    before = json["tick"].get<Tick>();
  }
  const auto join = nlohmann::json::parse(lines[0]);
  EXPECT_EQ(join["event"], "join");
  EXPECT_EQ(join["text"], "Ann");
  auto carve = nlohmann::json::parse(lines[1]);
  if (carve["event"] == "fill") carve = nlohmann::json::parse(lines[2]);
  EXPECT_EQ(carve["event"], "carve");
  EXPECT_TRUE(carve.contains("ms")) << "its tick's duration";
  const auto csv = exported(LineFormat::csv);
  ASSERT_EQ(csv.size(), lines.size() + 1);
  EXPECT_EQ(csv[0], event_csv_heads);
  EXPECT_TRUE(csv[1].starts_with("5,0.083,join,1.000,2.000,3.000,,,7,")) << csv[1];
}

TEST_F(EventsTest, export_of_ticks_has_a_line_each_whose_ledger_balances) {
  simulate(40);
  record();
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value());
  std::vector<std::string> lines;
  const auto done =
      export_ticks(**reader, LineFormat::jsonl, [&](const std::string& l) { lines.push_back(l); });
  ASSERT_TRUE(done.has_value()) << done.error().message;
  ASSERT_EQ(lines.size(), 40U);
  for (const std::string& line : lines) EXPECT_EQ(nlohmann::json::parse(line)["error_m3"], 0.0);
  const auto carved = nlohmann::json::parse(lines[9]);
  EXPECT_EQ(carved["tick"], 10);
  EXPECT_GT(carved["pieces_m3"].get<double>(), 0.5);
  EXPECT_GE(carved["operations"], 2);
}

TEST_F(EventsTest, a_recording_without_a_log_has_its_events_derived) {
  simulate(150);
  record();
  auto logged = recorded_events();
  std::erase_if(logged, [](const Event& e) { return e.kind == EventKind::contact; });  // frames have none
  {
    auto database = Database::open(path);
    ASSERT_TRUE(database.has_value());
    ASSERT_TRUE(database->execute("DROP TABLE events; DROP TABLE machine").has_value());
  }
  EXPECT_TRUE(verified().agrees());
  EXPECT_EQ(verified().events, 0U);
  const auto derived = exported(LineFormat::jsonl);
  ASSERT_EQ(derived.size(), logged.size());
  Event first = logged[0];
  first.session = 0;  // which the operations do not say
  EXPECT_EQ(derived[0], json_line(first, {60}));
}

TEST_F(EventsTest, events_that_are_no_events_are_refused_by_name) {
  simulate(20);
  record();
  const Event slow{.kind = EventKind::slow, .tick = 10};
  for (const std::vector<uint8_t>& bytes :
       {encode(std::span(&slow, 1)), std::vector<uint8_t>{0x0A, 0x02, 0x08, 0x7F},
        std::vector<uint8_t>{0xFF}}) {
    put_recorded("events", 10, bytes);
    const auto reader = RecordingReader::open(path);
    ASSERT_TRUE(reader.has_value());
    const auto events = (*reader)->events(1, 20);
    ASSERT_FALSE(events.has_value());
    EXPECT_TRUE(holds(events.error().message, "tick 10")) << events.error().message;
  }
}

TEST_F(EventsTest, the_log_appends_whole_lines) {
  const std::string file = (folder / "events.jsonl").string();
  for (int i = 0; i < 2; ++i) {
    auto log = EventLog::open(file);
    ASSERT_TRUE(log.has_value());
    (*log)->push("{\"a\":1}");
    (*log)->push("{\"b\":2}");
    (*log)->flush();
    EXPECT_EQ((*log)->status().written, 2U);
  }
  const auto bytes = read_file(file);
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "{\"a\":1}\n{\"b\":2}\n{\"a\":1}\n{\"b\":2}\n");
}

TEST_F(EventsTest, half_a_line_that_a_crash_has_left_is_cut_off_and_other_texts_stay) {
  const std::string file = (folder / "events.jsonl").string();
  for (const auto& [before, after] : {std::pair{"{\"a\":1}\n{\"half", "{\"a\":1}\n{}\n"},
                                      {"{\"half", "{}\n"},
                                      {"a letter", "a letter\n{}\n"}}) {
    std::ofstream(file) << before;
    auto log = EventLog::open(file);
    ASSERT_TRUE(log.has_value());
    (*log)->push("{}");
    ASSERT_TRUE((*log)->finish().has_value());
    const auto bytes = read_file(file);
    EXPECT_EQ(std::string(bytes.begin(), bytes.end()), after);
  }
}

TEST_F(EventsTest, a_file_at_its_limit_gets_no_half_line_and_all_lines_when_it_has_room_again) {
  const std::string file = (folder / "events.jsonl").string();
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{20, before.rlim_max};
  auto log = EventLog::open(file);
  ASSERT_TRUE(log.has_value());
  setrlimit(RLIMIT_FSIZE, &small);
  for (const char* line : {"{\"first\":1}", "{\"second\":2}"}) (*log)->push(line);
  while ((*log)->status().health.ok()) std::this_thread::yield();
  const auto at_limit = read_file(file);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(at_limit.empty() || at_limit.back() == '\n');
  EXPECT_TRUE(holds((*log)->status().health.because.value_or(""), "File too large"));
  ASSERT_TRUE((*log)->finish().has_value());
  EXPECT_EQ((*log)->status().health.lost, 0U);
  const auto bytes = read_file(file);
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "{\"first\":1}\n{\"second\":2}\n");
}

TEST_F(EventsTest, a_file_that_was_moved_away_is_made_anew) {
  const std::string file = (folder / "events.jsonl").string(), moved = file + ".1";
  auto log = EventLog::open(file);
  ASSERT_TRUE(log.has_value());
  (*log)->push("{\"a\":1}");
  (*log)->flush();
  std::filesystem::rename(file, moved);
  (*log)->push("{\"b\":2}");
  ASSERT_TRUE((*log)->finish().has_value());
  EXPECT_EQ(read_file(moved).size(), 8U);
  EXPECT_EQ(read_file(file).size(), 8U);
}

TEST_F(EventsTest, a_pipe_that_nobody_reads_is_refused) {
  const std::string pipe = (folder / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_FALSE(EventLog::open(pipe).has_value());
}

TEST_F(EventsTest, lines_that_are_being_written_count_among_those_that_wait) {
  const std::string pipe = (folder / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  ASSERT_EQ(::fcntl(reader, F_SETFL, O_RDONLY), 0);
  auto log = EventLog::open(pipe);
  ASSERT_TRUE(log.has_value());
  constexpr size_t more_than_a_pipe_holds = size_t{1} << 22;
  (*log)->push(std::string(more_than_a_pipe_holds, 'x'));
  char first = 0;
  ASSERT_EQ(::read(reader, &first, 1), 1) << "it is being written";
  for (size_t i = 0; i < limits::event_lines_max; ++i) (*log)->push("{}");
  EXPECT_EQ((*log)->status().health.lost, 1U);
  std::thread drain([&] {
    std::vector<char> bytes(65536);
    while (::read(reader, bytes.data(), bytes.size()) > 0) {
    }
  });
  EXPECT_TRUE((*log)->finish().has_value());
  EXPECT_EQ((*log)->status().written, limits::event_lines_max);
  log->reset();  // closes the pipe
  drain.join();
  ::close(reader);
}

TEST_F(EventsTest, a_disk_that_stays_full_loses_lines_counts_them_and_says_so_at_the_end) {
  auto log = EventLog::open("/dev/full");
  ASSERT_TRUE(log.has_value());
  for (int i = 0; i < 3; ++i) (*log)->push("{}");
  (*log)->flush();
  EXPECT_EQ((*log)->status().health.lost, 0U) << "they wait";
  EXPECT_EQ((*log)->status().written, 0U);
  EXPECT_TRUE(holds((*log)->status().health.because.value_or(""), "/dev/full"));
  const auto finished = (*log)->finish();
  ASSERT_FALSE(finished.has_value());
  EXPECT_TRUE(holds(finished.error().message, "3 events are lost")) << finished.error().message;
  EXPECT_FALSE(EventLog::open((folder / "missing" / "x").string()).has_value());
}

}  // namespace
}  // namespace scree
