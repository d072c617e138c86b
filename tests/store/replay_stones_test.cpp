// A replay has the stones of the ticks that it played, as those who were there saw them.
#include <gtest/gtest.h>

#include "server/replay/replay_source.h"
#include "server/world/published_state.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

std::set<PieceId> stones_of(const PublishedState& state) {
  std::set<PieceId> ids;
  for (const auto& [id, stone] : state.stones().all()) ids.insert(id);
  return ids;
}

TEST_F(RecordingTest, a_replay_has_the_stones_of_its_ticks_and_none_before_them_also_when_it_jumps) {
  simulate(700, 300);
  record();
  PublishedState live, played;
  std::map<Tick, std::set<PieceId>> seen;
  auto source = ReplaySource::open(path);
  ASSERT_TRUE(source.has_value()) << source.error().message;
  for (const auto& recorded : deltas) {
    live.apply(*recorded);
    const auto delta = (*source)->next();
    ASSERT_TRUE(delta.has_value() && *delta != nullptr);
    played.apply(**delta);
    ASSERT_EQ(stones_of(played), stones_of(live)) << "tick " << recorded->tick;
    seen[recorded->tick] = stones_of(live);
  }
  EXPECT_GE(stones_of(live).size(), 3U);
  TickDelta jumped = **(*source)->jump(0);
  jumped.tick = played.tick() + 1;
  played.apply(jumped);
  EXPECT_TRUE(stones_of(played).empty());
  ASSERT_NE(seen[345], seen[350]);
  for (const Tick to : {700U, 350U, 345U, 700U, 350U}) {
    jumped = **(*source)->jump(to);
    jumped.tick = played.tick() + 1;
    played.apply(jumped);
    EXPECT_EQ(stones_of(played), seen[to]) << to;
  }
  PublishedState anew;
  ASSERT_TRUE((*source)->seek(0).has_value());
  for (Tick now = 0; now < 350;) {
    const auto joint = (*source)->next(std::min<Tick>(7, 350 - now));
    ASSERT_TRUE(joint.has_value() && *joint != nullptr);
    TickDelta delta = **joint;
    now = delta.tick;
    delta.tick = anew.tick() + 1;
    anew.apply(delta);
  }
  EXPECT_EQ(stones_of(anew), seen[350]) << "ticks as one";
}

}  // namespace
}  // namespace scree
