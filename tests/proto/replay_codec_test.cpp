// What a replay's viewers are told of its events, and the cursors in a recording: news put over what is
// known, rows that stand for themselves, and what decoders refuse.
#include <algorithm>
#include <gtest/gtest.h>

#include "proto/codec.h"
#include "proto/marks.h"
#include "server/formats/event_codec.h"
#include "shared/base/random.h"

namespace scree {
namespace {

MarksMessage random_marks(Random& random, uint32_t columns) {
  MarksMessage marks{10, 4, 0, 10 + 4 * columns};
  for (const EventKind kind : all_kinds<EventKind>)
    for (uint32_t column = 0; column < columns; ++column)
      if (random.below(4) == 0) marks.marks.push_back({kind, column, 1 + random.below(9)});
  return marks;
}

TEST(Marks, news_make_what_is_known_what_is) {
  Random random(3);
  for (int round = 0; round < 50; ++round) {
    MarksMessage known = random_marks(random, 40);
    MarksMessage now = known;
    now.read_to += 8;
    const uint32_t from = random.below(44);
    constexpr EventKind last = all_kinds<EventKind>.back();  // marks are in the order of the kinds
    for (int i = 0; i < 5; ++i) now.marks.push_back({last, 40 + static_cast<uint32_t>(i), 1});
    std::erase_if(now.marks, [&](const Mark& mark) { return mark.column >= from && mark.count == 3; });
    const MarksMessage news = news_since(known, now);
    EXPECT_LE(news.marks.size(), now.marks.size());
    apply_news(known, news);
    EXPECT_EQ(known, now);
    EXPECT_TRUE(news_since(known, now).marks.empty()) << "nothing is told twice";
  }
}

TEST(Marks, longer_columns_are_told_whole_and_news_of_another_bar_change_nothing) {
  Random random(4);
  MarksMessage known = random_marks(random, 20);
  MarksMessage longer = random_marks(random, 20);
  longer.ticks_per_column = 8;
  EXPECT_EQ(news_since(known, longer), longer);
  const MarksMessage before = known;
  MarksMessage stray = longer;
  stray.from = 5;
  apply_news(known, stray);
  EXPECT_EQ(known, before);
  apply_news(known, longer);
  EXPECT_EQ(known, longer);
}

TEST(Marks, columns_beyond_the_last_or_without_events_are_refused) {
  const auto refused = [](const MarksMessage& marks) {
    const std::vector<uint8_t> bytes = encode(ServerMessage(marks));
    return !decode_server(std::span(bytes).subspan(4)).has_value();
  };
  EXPECT_FALSE(refused({0, 1, 0, 9, {{EventKind::carve, limits::mark_columns_max - 1, 1}}}));
  EXPECT_TRUE(refused({0, 1, 0, 9, {{EventKind::carve, 1, 0}}}));
  EXPECT_TRUE(refused({0, 1, 0, 9, {{EventKind::carve, 1, limits::mark_count_max + 1}}}));
  EXPECT_TRUE(refused({0, 1, 0, 9, {{EventKind::fill, 1, 1}, {EventKind::carve, 1, 1}}}));
  EXPECT_TRUE(refused({0, 1, limits::mark_columns_max + 1, 9}));
}

RecordedMachine walking(Tick last) {
  RecordedMachine machine;
  machine.tick = last;
  machine.tick_us.assign(60, 1000);
  const Tick first = last - 59;
  for (Tick tick = first; tick <= last; tick += 6) {
    const auto at = static_cast<float>(tick) * 0.25F;
    CursorSample sample{tick, {{3, "Ann", {at, 2.0F, -at}, {at, 0.5F, -100.0F}}}, {}};
    if (tick == first) sample.moved.push_back({9, "", {1.0F, 1.0F, 1.0F}, {}});
    if (tick == first + 30) sample.gone = {9};
    if (tick == first + 48) sample.moved.push_back({9, "Bo", {-7.0F, 1.0F, 1.0F}, {}});
    machine.cursors.push_back(std::move(sample));
  }
  return machine;
}

TEST(RecordedCursors, a_row_is_what_was_written_and_small) {
  const RecordedMachine machine = walking(600);
  const std::vector<uint8_t> bytes = encode(machine);
  const auto read = decode_recorded_machine(bytes);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->cursors, machine.cursors);
  RecordedMachine without = machine;
  without.cursors.clear();
  EXPECT_LT(bytes.size() - encode(without).size(), 200U) << "of a second, of one person who moves";
}

TEST(RecordedCursors, places_beyond_the_world_are_clamped_and_too_many_left_out) {
  RecordedMachine machine = walking(600);
  machine.cursors = {{541, {{1, "far", {1e30F, -1e30F, 0.0F}, {}}}, {}}};
  auto read = decode_recorded_machine(encode(machine));
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_GT(read->cursors[0].moved[0].eye_m.x, 1e6F);
  machine.cursors.clear();
  for (Tick tick = 541; tick <= 600; ++tick) {
    CursorSample sample{tick, {}, {}};
    for (uint64_t session = 1; session <= 100; ++session)
      sample.moved.push_back({session, "", {static_cast<float>(tick), 0.0F, 0.0F}, {}});
    machine.cursors.push_back(std::move(sample));
  }
  read = decode_recorded_machine(encode(machine));
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->cursors.size(), limits::cursors_per_row_max / 100);
}

TEST(RecordedCursors, no_bytes_crash_a_decoder) {
  const std::vector<uint8_t> whole = encode(walking(600));
  for (size_t size = 0; size < whole.size(); ++size)
    static_cast<void>(decode_recorded_machine(std::span(whole).first(size)));
  Random random(5);
  size_t refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<uint8_t> bytes = whole;
    for (int i = 0; i < 3; ++i)
      bytes[random.below(static_cast<uint32_t>(bytes.size()))] = static_cast<uint8_t>(random.below(256));
    const auto read = decode_recorded_machine(bytes);
    if (!read) {
      ++refused;
      continue;
    }
    for (const CursorSample& sample : read->cursors) {
      EXPECT_LE(sample.tick, read->tick);
      EXPECT_TRUE(std::ranges::is_sorted(sample.moved, {}, &PlayerCursor::session));
    }
  }
  EXPECT_GT(refused, 100U);
}

}  // namespace
}  // namespace scree
