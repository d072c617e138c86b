// Recordings that are played while they are written: a replay follows their end; and what goes with a moment,
// its events and who was there.
#include <gtest/gtest.h>

#include "server/replay/event_marks.h"
#include "server/replay/recorded_cursors.h"
#include "server/replay/replay_player.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

class GrowingRecordingTest : public RecordingTest {
 protected:
  void begin(Tick ticks) {
    simulate(ticks);
    auto created = RecordingWriter::create(path, {"test", small_world()});
    ASSERT_TRUE(created.has_value()) << created.error().message;
    writer = std::move(*created);
  }
  void write_to(Tick tick) {
    for (; written < tick; ++written)
      ASSERT_TRUE(
          writer->add(*deltas[written], commands_by_tick[written], {}, nullptr, cursors_at(written + 1))
              .has_value());
    ASSERT_TRUE(writer->commit().has_value());
  }
  /// Ann walks along x, ten times a second; Bo stands, and is gone after tick 100.
  static std::optional<std::vector<PlayerCursor>> cursors_at(Tick tick) {
    if (tick % 6 != 0) return std::nullopt;
    const auto x_m = static_cast<float>(tick) * 0.125F;
    std::vector<PlayerCursor> cursors{{3, "Ann", {x_m, 2.0F, 0.0F}, {x_m, 0.0F, -8.0F}}};
    if (tick <= 100) cursors.push_back({7, "Bo", {1.0F, 2.0F, 3.0F}, {0.0F, 0.0F, 0.0F}});
    return cursors;
  }
  void open(const PlayerOptions& options = {}) {
    auto source = ReplaySource::open(path);
    ASSERT_TRUE(source.has_value()) << source.error().message;
    player.emplace(std::move(*source), options);
  }
  /// False at the end.
  bool step() {
    const auto delta = player->next();
    EXPECT_TRUE(delta.has_value()) << delta.error().message;
    last = delta ? *delta : nullptr;
    return last != nullptr;
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) ASSERT_TRUE(step());
  }
  Tick moment() const { return last->playback->moment; }

  std::unique_ptr<RecordingWriter> writer;
  Tick written = 0;
  std::optional<ReplayPlayer> player;
  std::shared_ptr<const TickDelta> last;
};

TEST_F(GrowingRecordingTest, a_replay_waits_at_the_end_and_goes_on_when_more_comes) {
  begin(400);
  write_to(30);
  open();
  steps(40);
  EXPECT_EQ(moment(), 30U);
  EXPECT_TRUE(last->playback->playing);
  EXPECT_TRUE(last->playback->grows);
  write_to(200);
  steps(60);
  EXPECT_GT(moment(), 50U);
  EXPECT_EQ(last->playback->last, 200U);
  EXPECT_EQ(last->field_hash, deltas[moment() - 1]->field_hash);
  ASSERT_TRUE(player->request({.move = ReplayMove::to_tick, .value = 200}).has_value());
  steps(4);
  EXPECT_EQ(moment(), 200U);
  write_to(400);
  ASSERT_TRUE(writer->finish().has_value()) << "although somebody reads it";
  steps(61 + 260);
  EXPECT_EQ(moment(), 400U);
  EXPECT_FALSE(last->playback->playing) << "it has ended";
  EXPECT_FALSE(last->playback->grows);
  EXPECT_EQ(last->field_hash, deltas[399]->field_hash);
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_TRUE((*reader)->is_ended()) << "it says so itself";
}

TEST_F(GrowingRecordingTest, one_that_was_cut_short_ends_after_some_quiet_seconds) {
  begin(30);
  write_to(30);
  open({.at_end = AtEnd::end});
  int count = 0;
  while (step() && count < 1000) ++count;
  EXPECT_EQ(last, nullptr);
  EXPECT_GT(count, 60) << "it waits a while";
}

TEST_F(GrowingRecordingTest, ticks_that_a_world_has_lost_are_an_error) {
  begin(60);
  write_to(60);
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  writer.reset();
  auto database = Database::open(path);
  ASSERT_TRUE(database && database->execute("DELETE FROM frames WHERE tick > 40").has_value());
  const auto looked = (*reader)->refresh();
  ASSERT_FALSE(looked.has_value());
  EXPECT_NE(looked.error().message.find("after 40"), std::string::npos) << looked.error().message;
}

TEST_F(GrowingRecordingTest, who_was_there_is_there_at_every_moment) {
  begin(250);
  write_to(250);
  ASSERT_TRUE(writer->finish().has_value());
  auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  RecordedCursors cursors;
  // Forwards, backwards, and over the borders of rows.
  for (const Tick tick : {6U, 7U, 58U, 60U, 61U, 62U, 100U, 240U, 119U, 120U, 12U, 90U}) {
    const auto there = cursors.at(**reader, tick);
    ASSERT_TRUE(there.has_value()) << there.error().message;
    ASSERT_EQ(there->size(), tick < 102 ? 2U : 1U) << tick;
    EXPECT_EQ((*there)[0].name, "Ann");
    EXPECT_NEAR((*there)[0].eye_m.x, static_cast<float>(tick) * 0.125F, 0.02F) << tick;
    if (there->size() < 2) continue;
    EXPECT_EQ((*there)[1].name, "Bo");
    EXPECT_EQ((*there)[1].eye_m, glm::vec3(1.0F, 2.0F, 3.0F));
  }
  const auto before = cursors.at(**reader, 2);
  ASSERT_TRUE(before.has_value());
  EXPECT_TRUE(before->empty());
}

TEST_F(GrowingRecordingTest, a_player_says_who_was_there) {
  begin(120);
  write_to(120);
  ASSERT_TRUE(writer->finish().has_value());
  open();
  std::shared_ptr<const RecordedCursorsMessage> told;
  for (int i = 0; i < 60; ++i) {
    ASSERT_TRUE(step());
    if (last->cursors) told = last->cursors;
  }
  ASSERT_NE(told, nullptr);
  ASSERT_EQ(told->cursors.size(), 2U);
  EXPECT_NEAR(told->cursors[0].eye_m.x, 7.5F, 0.02F);
}

TEST_F(GrowingRecordingTest, marks_count_all_events_whatever_the_recording_grows_to) {
  begin(500);
  EventMarks marks;
  std::unique_ptr<RecordingReader> reader;
  for (const Tick tick : {5U, 130U, 131U, 500U}) {
    write_to(tick);
    if (reader == nullptr) {
      auto opened = RecordingReader::open(path);
      ASSERT_TRUE(opened.has_value()) << opened.error().message;
      reader = std::move(*opened);
    }
    ASSERT_TRUE(reader->refresh().has_value());
    for (int i = 0; i < 40; ++i) ASSERT_TRUE(marks.read_on(*reader).has_value());
    const MarksMessage& message = *marks.message();
    EXPECT_EQ(message.read_to, tick);
    std::array<uint64_t, kind_count<EventKind>> counted{}, recorded{};
    for (const Mark& mark : message.marks) counted[static_cast<size_t>(mark.kind)] += mark.count;
    const auto events = reader->events(1, tick);
    ASSERT_TRUE(events.has_value());
    for (const Event& event : *events) ++recorded[static_cast<size_t>(event.kind)];
    EXPECT_EQ(counted, recorded) << tick;
  }
}

TEST(EventMarks, columns_become_longer_and_none_is_beyond_the_last) {
  MarksMessage before;
  for (const Tick last : {Tick{1}, Tick{1024}, Tick{1025}, Tick{100000}}) {
    EventMarks marks;
    for (Tick tick = 1; tick <= last; tick += 7) marks.add({.kind = EventKind::carve, .tick = tick});
    const MarksMessage now = marks.put_together();
    uint64_t count = 0;
    for (const Mark& mark : now.marks) {
      EXPECT_LT(mark.column, limits::mark_columns_max);
      count += mark.count;
    }
    EXPECT_EQ(count, (last + 6) / 7);
    EXPECT_LE((last - 1) / 7 * 7 / limits::mark_columns_max, now.ticks_per_column);
    EXPECT_GE(now.ticks_per_column, before.ticks_per_column);
    before = now;
  }
}

}  // namespace
}  // namespace scree
