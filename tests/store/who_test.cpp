// Who asked for what, and when: recordings say it for every event and every request, also behind the parts
// that a ring has dropped and in shorter recordings.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/formats/event_codec.h"
#include "server/replay/recording_excerpt.h"
#include "server/replay/request_lines.h"
#include "server/replay/verify.h"
#include "server/store/roster.h"
#include "server/world/settings.h"
#include "shared/base/wall_clock.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

TEST(WallClock, is_shown_with_its_zone) {
  EXPECT_EQ(iso_time(0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(iso_time(1'795'648'348'007), "2026-11-25T23:12:28.007Z");
  EXPECT_EQ(iso_time(UINT64_MAX), "") << "no year has four digits then";
  EXPECT_GT(unix_now_ms(), 1'700'000'000'000U);
}

TEST(Roster, knows_the_last_sessions) {
  Roster roster;
  for (uint64_t session = 1; session <= limits::roster_max + 1; ++session)
    roster.note({.kind = EventKind::join, .session = session, .text = "Ann", .token_id = session});
  roster.note({.kind = EventKind::leave, .session = 5, .text = "Ann"});
  EXPECT_EQ(roster.find(1).name, "") << "forgotten";
  EXPECT_EQ(roster.find(5).token_id, 5U) << "what it asked for may still come";
  EXPECT_EQ(roster.all().size(), limits::roster_max);
}

class WhoTest : public RecordingTest {
 protected:
  /// Ann joins in tick 2 by a token; she carves in tick 10, and somebody without a name fills there.
  void record_ann() {
    simulate(130);
    const uint64_t before_ms = unix_now_ms();
    auto recorder = Recorder::create(path, {"test", small_world()});
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    for (size_t i = 0; i < deltas.size(); ++i) {
      std::vector<Event> noted;
      if (i == 1)
        noted.push_back(
            {.kind = EventKind::join, .tick = 2, .session = 1, .text = "Ann, B", .token_id = 0xABC});
      (*recorder)->push(deltas[i], commands_by_tick[i], noted);
    }
    ASSERT_TRUE((*recorder)->finish().has_value());
    written_ms = before_ms;
  }
  static std::vector<std::string> requests_of(const std::string& file, LineFormat format) {
    const auto reader = RecordingReader::open(file);
    EXPECT_TRUE(reader.has_value()) << reader.error().message;
    std::vector<std::string> lines;
    const auto done =
        export_requests(**reader, format, [&](const std::string& line) { lines.push_back(line); });
    EXPECT_TRUE(done.has_value()) << done.error().message;
    return lines;
  }
  static nlohmann::json first_event(const std::string& file, const std::string& kind) {
    nlohmann::json found;
    const auto done = export_events(file, {}, LineFormat::jsonl, [&](const std::string& line) {
      if (const auto json = nlohmann::json::parse(line); found.is_null() && json["event"] == kind)
        found = json;
    });
    EXPECT_TRUE(done.has_value()) << done.error().message;
    return found;
  }
  uint64_t written_ms = 0;
};

TEST_F(WhoTest, events_say_session_name_token_and_time_of_day) {
  record_ann();
  const auto carve = first_event(path, "carve");
  EXPECT_EQ(carve["session"], 1);
  EXPECT_EQ(carve["name"], "Ann, B");
  EXPECT_EQ(carve["token"], "0000000000000abc");
  const auto fill = first_event(path, "fill");
  EXPECT_EQ(fill["session"], 2);
  EXPECT_FALSE(fill.contains("name"));
  EXPECT_FALSE(fill.contains("token"));
  // The ticks of a test come faster than those of a clock, so that the first ones seem to be earlier.
  const std::string at = carve["at"];
  EXPECT_GE(at, iso_time(written_ms - 60'000));
  EXPECT_LE(at, iso_time(unix_now_ms()));
  EXPECT_EQ(at.back(), 'Z');
}

TEST_F(WhoTest, each_request_is_a_line_with_who_asked) {
  record_ann();
  const auto lines = requests_of(path, LineFormat::jsonl);
  ASSERT_EQ(lines.size(), 4U);
  const auto carve = nlohmann::json::parse(lines[0]);
  EXPECT_EQ(carve["tick"], 10);
  EXPECT_EQ(carve["request"], "carve");
  EXPECT_EQ(carve["name"], "Ann, B");
  EXPECT_EQ(carve["token"], "0000000000000abc");
  EXPECT_EQ(carve["x_m"], 3.0);
  EXPECT_EQ(carve["reach_m"], 1.0);
  EXPECT_EQ(nlohmann::json::parse(lines[1])["session"], 2);
  const auto csv = requests_of(path, LineFormat::csv);
  ASSERT_EQ(csv.size(), 5U);
  EXPECT_EQ(csv[0], request_csv_heads);
  EXPECT_NE(csv[1].find(",carve,1,\"Ann, B\",0000000000000abc,1,3.0,"), std::string::npos) << csv[1];
}

TEST_F(WhoTest, settings_say_who_changed_them) {
  World world(small_world());
  const std::vector<Command> change{{7, 1, SettingsRequest{{{"impacts", "false"}}}}};
  const auto delta = world.step(change);
  EXPECT_EQ(delta->settings_by, 7U);
  EventDeriver deriver(0.25F, print(small_world()));
  const auto events = deriver.events_of(*delta);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].session, 7U);
}

TEST_F(WhoTest, a_part_of_a_recording_knows_who_joined_before_it) {
  World world(small_world());
  for (int tick = 0; tick < 5; ++tick) world.step({});
  {
    auto recorder = Recorder::create(path, {"test", small_world()},
                                     {world.moment(), world.keyframe(), {}, {{1, "Ann", 0xABC}}});
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    const std::vector<Command> commands{carve_at(0.0F, 1)};
    (*recorder)->push(world.step(commands), commands);
  }
  EXPECT_EQ(first_event(path, "carve")["name"], "Ann");
}

TEST_F(WhoTest, a_shorter_recording_knows_who_joined_and_when) {
  record_ann();
  const std::string cut = (folder / "cut.scree").string();
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value());
  const auto done = write_excerpt(**reader, cut, 100, 130, {});
  ASSERT_TRUE(done.has_value()) << done.error().message;
  EXPECT_EQ(first_event(cut, "carve")["name"], "Ann, B");
  EXPECT_EQ(first_event(cut, "carve")["tick"], 110);
  const auto lines = requests_of(cut, LineFormat::jsonl);
  ASSERT_EQ(lines.size(), 2U);
  const auto whole = requests_of(path, LineFormat::jsonl);
  EXPECT_EQ(nlohmann::json::parse(lines[0])["at"], nlohmann::json::parse(whole[2])["at"]);
}

TEST_F(WhoTest, a_recording_whose_events_do_not_say_who_verifies) {
  record_ann();
  const auto events = [&] {
    const auto reader = RecordingReader::open(path);
    return (*reader)->events(10);
  }();
  ASSERT_TRUE(events.has_value());
  std::vector<Event> older = *events;
  for (Event& event : older) event.session = 0;
  put_recorded("events", 10, encode(std::span<const Event>(older)));
  auto reader = RecordingReader::open(path);
  const auto report = verify(**reader);
  ASSERT_TRUE(report.has_value());
  EXPECT_TRUE(report->agrees()) << report->difference;
  older[0].session = 3;
  put_recorded("events", 10, encode(std::span<const Event>(older)));
  reader = RecordingReader::open(path);
  EXPECT_FALSE(verify(**reader)->agrees()) << "another session is a difference";
}

}  // namespace
}  // namespace scree
