// The player of a recording: whatever is asked of it, ticks go on without a gap, and who applies them has the
// recorded state of the moment that it says.
#include "server/replay/replay_player.h"

#include <gtest/gtest.h>

#include "server/store/limits.h"
#include "server/world/published_state.h"
#include "shared/base/random.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

class ReplayPlayerTest : public RecordingTest {
 protected:
  void play(Tick ticks, const PlayerOptions& options = {}, Tick from = 0) {
    simulate(ticks);
    record();
    auto source = ReplaySource::open(path, from);
    ASSERT_TRUE(source.has_value()) << source.error().message;
    player.emplace(std::move(*source), options);
  }
  void ask(const ControlReplayRequest& wish) { ASSERT_TRUE(player->request(wish).has_value()); }
  void go_to(Tick tick) { ask({.move = ReplayMove::to_tick, .value = static_cast<int64_t>(tick)}); }
  /// One tick, compared with what was recorded. False at the end.
  bool step() {
    const auto delta = player->next();
    EXPECT_TRUE(delta.has_value()) << delta.error().message;
    if (!delta || *delta == nullptr) return false;
    if (published.tick() != 0) {
      EXPECT_EQ((*delta)->tick, published.tick() + 1);
    }
    published.apply(**delta);
    moment = (*delta)->playback.value().moment;
    playing = (*delta)->playback->playing;
    expect_moment();
    return !HasFailure();
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) ASSERT_TRUE(step()) << "step " << i;
  }
  void expect_moment() const {
    const uint64_t hash = moment == 0 ? 0 : deltas[moment - 1]->field_hash;
    const std::vector<PieceState> pieces =
        moment == 0 ? std::vector<PieceState>() : deltas[moment - 1]->pieces;
    EXPECT_EQ(published.field_hash(), hash) << "moment " << moment;
    uint64_t sum = 0;
    for (const auto& [coord, chunk] : published.chunks()) {
      uint64_t bricks = 0;
      for (const auto& [brick, state] : chunk.bricks) bricks += state.hash;
      EXPECT_EQ(bricks, chunk.hash);
      sum += bricks;
    }
    EXPECT_EQ(sum, hash) << "moment " << moment;
    ASSERT_EQ(published.pieces().size(), pieces.size()) << "moment " << moment;
    for (const PieceState& piece : pieces) EXPECT_EQ(published.pieces().at(piece.id).pose, piece.pose);
    if (moment > 0) {
      EXPECT_EQ(published.ledger(), deltas[moment - 1]->ledger);
    }
  }

  std::optional<ReplayPlayer> player;
  PublishedState published;
  Tick moment = 0;
  bool playing = true;
};

TEST_F(ReplayPlayerTest, plays_tick_by_tick_and_stays_at_the_end) {
  play(40);
  for (Tick tick = 1; tick <= 40; ++tick) {
    ASSERT_TRUE(step());
    EXPECT_EQ(moment, tick);
  }
  EXPECT_TRUE(playing);
  steps(5);
  EXPECT_EQ(moment, 40U);
  EXPECT_FALSE(playing);
}

TEST_F(ReplayPlayerTest, ends_where_it_is_to_end) {
  play(5, {.at_end = AtEnd::end});
  steps(5);
  EXPECT_FALSE(step());
}

TEST_F(ReplayPlayerTest, a_loop_goes_on_from_where_it_began) {
  play(20, {.at_end = AtEnd::loop}, 10);
  steps(11);
  EXPECT_EQ(moment, 20U);
  for (int i = 0; i < 3 && moment == 20; ++i) ASSERT_TRUE(step()) << "it waits for a tick with poses";
  EXPECT_EQ(moment, 10U);
  steps(5);
  EXPECT_EQ(moment, 15U);
}

TEST_F(ReplayPlayerTest, stands_still_while_it_is_paused_and_steps_either_way) {
  play(60);
  steps(20);
  ask({.play = ReplayPlay::pause});
  steps(10);
  EXPECT_EQ(moment, 20U);
  ask({.move = ReplayMove::by_ticks, .value = 1});
  steps(3);
  EXPECT_EQ(moment, 21U);
  ask({.move = ReplayMove::by_ticks, .value = -11});
  ask({.move = ReplayMove::by_ticks, .value = -1});
  steps(3);
  EXPECT_EQ(moment, 9U) << "before the carve of tick 10";
  EXPECT_EQ(player->state().heeded, 4U);
  ask({.play = ReplayPlay::play});
  steps(4);
  EXPECT_EQ(moment, 13U);
}

TEST_F(ReplayPlayerTest, speeds_from_a_tenth_to_sixteen) {
  play(400);
  ask({.speed = 16.0F});
  steps(20);
  EXPECT_EQ(moment, 1U + 19 * 16) << "the first tick is the first";
  go_to(0);
  ask({.speed = 0.1F});
  steps(3);
  const Tick begun = moment;
  steps(100);
  EXPECT_NEAR(static_cast<double>(moment - begun), 10.0, 1.0);
}

TEST_F(ReplayPlayerTest, plays_backwards_to_the_start_and_stays) {
  play(250);
  go_to(250);
  steps(4);
  ask({.play = ReplayPlay::play, .speed = -2.0F});
  Tick before = moment;
  for (int i = 0; i < 200 && moment > 0; ++i) {
    ASSERT_TRUE(step());
    EXPECT_LE(moment, before);
    EXPECT_GE(moment + 6, before);
    before = moment;
  }
  EXPECT_EQ(moment, 0U);
  EXPECT_TRUE(published.chunks().empty()) << "untouched again";
  steps(3);
  EXPECT_FALSE(playing);
}

TEST_F(ReplayPlayerTest, random_jumps_give_the_recorded_states) {
  constexpr Tick ticks = limits::ticks_per_keyframe + 150;
  play(ticks);
  Random random(7);
  steps(1);
  for (int i = 0; i < 60; ++i) {
    const Tick to = random.below(ticks + 1);
    go_to(to);
    if (random.below(3) == 0) go_to(random.below(ticks + 1));  // the later one counts
    steps(1 + static_cast<int>(random.below(8)));
    if (HasFatalFailure() || HasFailure()) return;
  }
}

TEST_F(ReplayPlayerTest, goes_to_events_and_times_and_no_farther_than_the_ends) {
  play(250);
  ask({.play = ReplayPlay::pause});
  steps(2);
  const auto to = [&](ReplayMove move, int64_t value) {
    ask({.move = move, .value = value});
    steps(3);
    return moment;
  };
  EXPECT_EQ(to(ReplayMove::next_event, 0), 10U);
  EXPECT_EQ(to(ReplayMove::to_time, 2000), 120U);
  EXPECT_EQ(to(ReplayMove::to_tick, 105), 105U);
  EXPECT_LT(to(ReplayMove::previous_event, 0), 105U);
  EXPECT_EQ(to(ReplayMove::to_tick, 11), 11U);
  EXPECT_EQ(to(ReplayMove::previous_event, 0), 10U);
  EXPECT_EQ(to(ReplayMove::previous_event, 0), 10U) << "there is none before: it stays";
  EXPECT_EQ(to(ReplayMove::to_tick, 9999999), 250U);
  EXPECT_EQ(to(ReplayMove::by_ticks, INT64_MIN), 0U);
}

TEST_F(ReplayPlayerTest, too_many_wishes_at_once_are_refused) {
  play(5);
  for (size_t i = 0; i < limits::replay_wishes_max; ++i) ask({.play = ReplayPlay::play});
  EXPECT_FALSE(player->request({.play = ReplayPlay::play}).has_value());
  steps(1);
  EXPECT_TRUE(player->request({.play = ReplayPlay::play}).has_value());
}

}  // namespace
}  // namespace scree
