// A recording that was cut out of another one plays and verifies by itself.
#include "server/replay/recording_excerpt.h"

#include <gtest/gtest.h>

#include "server/replay/recorded_moment.h"
#include "server/replay/recording_diff.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "tests/support/holds.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

class RecordingCutTest : public RecordingTest {
 protected:
  Result<ExcerptReport> excerpt_to(const std::string& name, Tick first, Tick last) {
    const auto reader = TRY(RecordingReader::open(path));
    return write_excerpt(*reader, (folder / name).string(), first, last, {});
  }
  void expect_verifies_from(const std::string& file, Tick first, Tick last) const {
    const auto reader = RecordingReader::open(file);
    ASSERT_TRUE(reader.has_value()) << reader.error().message;
    EXPECT_TRUE((*reader)->is_ended());
    EXPECT_EQ((*reader)->first_tick(), first);
    EXPECT_EQ((*reader)->last_tick(), last);
    const auto report = verify(**reader);
    ASSERT_TRUE(report.has_value()) << report.error().message;
    EXPECT_TRUE(report->agrees()) << report->first_difference << ": " << report->difference;
    EXPECT_EQ(report->ticks, last - first + 1);
    EXPECT_EQ(report->state_hash, deltas[last - 1]->state_hash);
    auto source = ReplaySource::open(file, first + 3);
    ASSERT_TRUE(source.has_value()) << source.error().message;
    ASSERT_TRUE((*source)->seek(first - 1).has_value());
    Tick tick = 0;
    while (tick < last) {
      const auto played = (*source)->next();
      ASSERT_TRUE(played && *played) << tick;
      tick = (*played)->tick;
      EXPECT_EQ((*played)->field_hash, deltas[tick - 1]->field_hash) << tick;
    }
  }
};

TEST_F(RecordingCutTest, a_cut_has_the_ticks_as_they_were_and_verifies_by_itself) {
  simulate(330);
  record();
  const auto report = excerpt_to("cut.scree", 115, 230);  // pieces of the carve in tick 110 fall
  ASSERT_TRUE(report.has_value()) << report.error().message;
  const std::string file = (folder / "cut.scree").string();
  expect_verifies_from(file, 115, 230);
  const auto found = diff({path, {}}, {file, {}});
  ASSERT_TRUE(found.has_value()) << found.error().message;
  ASSERT_EQ(found->stages.size(), 1U);
  EXPECT_EQ(found->stages[0].stage, DiffStage::extent) << found->stages[0].text;
}

TEST_F(RecordingCutTest, a_cut_of_a_cut_and_one_from_the_first_tick_verify) {
  simulate(240);
  record();
  const std::string whole = path;
  ASSERT_TRUE(excerpt_to("begin.scree", 1, 130).has_value());
  expect_verifies_from((folder / "begin.scree").string(), 1, 130);
  ASSERT_TRUE(excerpt_to("one.scree", 50, 200).has_value());
  path = (folder / "one.scree").string();
  const auto two = excerpt_to("two.scree", 120, 140);
  ASSERT_TRUE(two.has_value()) << two.error().message;
  expect_verifies_from((folder / "two.scree").string(), 120, 140);
}

TEST_F(RecordingCutTest, a_cut_begins_from_a_later_quiet_moment_whose_terrain_is_edited) {
  simulate(760, 300);
  record();
  const auto report = excerpt_to("cut.scree", 715, 750);
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_GT(report->state, 600U) << "states are remembered on the way";
  expect_verifies_from((folder / "cut.scree").string(), 715, 750);
}

TEST_F(RecordingCutTest, durations_and_events_of_the_machine_are_kept) {
  simulate(150);
  {
    auto recorder = Recorder::create(path, {"test", small_world()});
    ASSERT_TRUE(recorder.has_value());
    for (size_t i = 0; i < deltas.size(); ++i) {
      TickDelta timed = *deltas[i];
      timed.times = {};
      timed.times.ms.front() = static_cast<double>(i + 1);
      std::vector<Event> noted;
      if (i == 99) noted = {{.kind = EventKind::join, .tick = 100, .session = 7, .text = "Ann"}};
      (*recorder)->push(std::make_shared<const TickDelta>(timed), commands_by_tick[i], noted);
    }
    ASSERT_TRUE((*recorder)->finish().has_value());
  }
  ASSERT_TRUE(excerpt_to("cut.scree", 90, 120).has_value());
  const auto reader = RecordingReader::open((folder / "cut.scree").string());
  ASSERT_TRUE(reader.has_value());
  const auto rows = (*reader)->machine(90, 120);
  ASSERT_TRUE(rows.has_value());
  std::vector<uint32_t> tick_us;
  std::vector<Event> events;
  for (const RecordedMachine& row : *rows) {
    tick_us.insert(tick_us.end(), row.tick_us.begin(), row.tick_us.end());
    events.insert(events.end(), row.events.begin(), row.events.end());
  }
  ASSERT_EQ(tick_us.size(), 31U);
  EXPECT_EQ(tick_us.front(), 90000U);
  EXPECT_EQ(tick_us.back(), 120000U);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].tick, 100U);
}

TEST_F(RecordingCutTest, nothing_is_overwritten_and_nothing_is_left_of_a_cut_that_fails) {
  simulate(30);
  record();
  write_file(folder / "dear.scree", {'d', 'e', 'a', 'r'});
  const auto over = excerpt_to("dear.scree", 1, 20);
  ASSERT_FALSE(over.has_value());
  EXPECT_TRUE(holds(over.error().message, "exists already")) << over.error().message;
  EXPECT_EQ(read_file(folder / "dear.scree").size(), 4U);
  EXPECT_FALSE(excerpt_to("late.scree", 20, 31).has_value());
  EXPECT_FALSE(excerpt_to("odd.scree", 20, 10).has_value());
  put_recorded("commands", 10, {0xFF});
  EXPECT_FALSE(excerpt_to("damaged.scree", 15, 20).has_value());
  size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, 2U) << "the recording, and the one that was there";
}

TEST(RecordedTime, is_a_tick_or_a_time_and_nothing_else) {
  const auto tick = [](const std::string& text) {
    const auto moment = parse_tick_or_time(text);
    return moment ? moment->nearest_tick(60) : 999999;
  };
  EXPECT_EQ(tick("5400"), 5400U);
  EXPECT_EQ(tick("90s"), 5400U);
  EXPECT_EQ(tick("1.5m"), 5400U);
  EXPECT_EQ(tick("1:30"), 5400U);
  EXPECT_EQ(tick("1:00:01.5"), 216090U);
  EXPECT_EQ(tick("1h"), 216000U);
  EXPECT_EQ(tick("2:03"), 7380U);
  EXPECT_EQ(parse_tick_or_time("12.51s")->tick(60), 12.51 * 60.0) << "films have moments between two ticks";
  for (const char* wrong : {"",
                            "-1",
                            "1.5",
                            "s",
                            "1::2",
                            "1:",
                            ":1",
                            "1:2:3:4",
                            "nan",
                            "1e3",
                            "1..2s",
                            "0x10",
                            "99999999999999999999",
                            "m",
                            "-1s",
                            "1e99s",
                            "nans",
                            "ten",
                            "5 s",
                            "5ss"})
    EXPECT_FALSE(parse_tick_or_time(wrong).has_value()) << wrong;
}

}  // namespace
}  // namespace scree
