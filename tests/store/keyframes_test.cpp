// Keyframes of recordings: near every tick, and small.
#include <gtest/gtest.h>
#include <set>

#include "server/replay/replay_source.h"
#include "server/store/limits.h"
#include "server/store/schema.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

TEST_F(RecordingTest, a_keyframe_is_near_every_tick_and_has_the_whole_state) {
  simulate(700);
  record();
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.has_value());
  PublishedState published;
  for (const auto& delta : deltas) {
    published.apply(*delta);
    const Tick tick = delta->tick;
    if (tick < 60 || tick % 3 != 0) continue;  // before the first carve there is nothing to keep
    const auto near = (*reader)->keyframe_tick_before(tick);
    ASSERT_TRUE(near.has_value());
    EXPECT_LT(tick - *near,
              delta->pieces.empty() ? limits::ticks_per_idle_keyframe : limits::ticks_per_keyframe)
        << tick;
    if (tick != *near) continue;
    const auto keyframe = (*reader)->keyframe_before(tick);
    ASSERT_TRUE(keyframe.has_value() && keyframe->has_value());
    EXPECT_EQ(encode(**keyframe), encode(to_recorded_keyframe(published.as_delta()))) << tick;
  }
}

TEST_F(RecordingTest, keyframes_hold_each_volume_once_and_of_the_terrain_what_changed) {
  simulate(400);
  record();
  auto database = Database::open(path);
  ASSERT_TRUE(database.has_value());
  std::set<PieceId> seen;
  for (const auto& delta : deltas)
    if (delta->tick % limits::ticks_per_keyframe == 0)
      for (const PieceState& piece : delta->pieces) seen.insert(piece.id);
  EXPECT_EQ(database->number("SELECT count(*) FROM keyframe_pieces").value().value_or(0),
            static_cast<int64_t>(seen.size()));
  const auto twice = database->number(
      "SELECT count(*) FROM keyframe_chunks AS a JOIN keyframe_chunks AS b USING (chunk, hash) WHERE a.id < "
      "b.id");
  EXPECT_EQ(twice.value().value_or(1), 0) << "a chunk that did not change was written again";
}

}  // namespace
}  // namespace scree
