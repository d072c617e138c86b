// Messages that wait for a clock a little behind the server: in order, bounded, and through jitter and jumps.
#include "client/session/playback.h"

#include <gtest/gtest.h>
#include <vector>

#include "client/session/limits.h"

namespace scree {
namespace {

FrameMessage frame(Tick tick) {
  FrameMessage message;
  message.tick = tick;
  return message;
}

Tick tick_of(const Received& received) {
  return std::get<FrameMessage>(received.message).tick;
}

void push(Playback& playback, ServerMessage message, double arrived_s) {
  using std::chrono::steady_clock;
  const std::chrono::duration<double> arrived(arrived_s);
  playback.push({std::move(message), 0,
                 steady_clock::time_point(std::chrono::duration_cast<steady_clock::duration>(arrived))});
}

std::vector<Received> pop_due(Playback& playback, double now_s) {
  std::vector<Received> due;
  while (std::optional<Received> next = playback.pop_next(now_s)) due.push_back(std::move(*next));
  return due;
}

TEST(Playback, frames_wait_for_the_clock_and_keep_their_order) {
  Playback playback;
  playback.start(WelcomeMessage{});
  const double start_s = 1000.0;
  for (Tick tick = 1; tick <= 30; ++tick)
    push(playback, frame(tick), start_s + static_cast<double>(tick) / 60.0);
  const double now_s = start_s + 30.0 / 60.0;
  const std::vector<Received> due = pop_due(playback, now_s);
  ASSERT_FALSE(due.empty());
  for (size_t i = 0; i < due.size(); ++i) EXPECT_EQ(tick_of(due[i]), i + 1);
  // 100 ms behind, of which the interval of the transforms is part.
  EXPECT_NEAR(static_cast<double>(due.size()), 30.0 - (limits::playback_delay_s * 60.0 - 3.0), 1.01);
  EXPECT_NEAR(playback.draw_tick(now_s), 30.0 - limits::playback_delay_s * 60.0, 0.01);
  EXPECT_EQ(pop_due(playback, now_s + 1.0).size(), 30 - due.size());
}

TEST(Playback, what_comes_behind_a_frame_waits_with_it) {
  Playback playback;
  playback.start(WelcomeMessage{});
  push(playback, frame(60), 10.0);
  push(playback, StatusMessage{}, 10.0);
  EXPECT_TRUE(pop_due(playback, 10.0).empty());
  EXPECT_EQ(pop_due(playback, 10.2).size(), 2U);
}

TEST(Playback, messages_are_taken_one_by_one_as_well) {
  Playback playback;
  playback.start(WelcomeMessage{});
  push(playback, ChunkMessage{}, 10.0);
  push(playback, frame(60), 10.0);
  ASSERT_TRUE(playback.pop_next(10.0));
  EXPECT_FALSE(playback.pop_next(10.0)) << "the frame is not due";
  push(playback, frame(61), 10.0);
  EXPECT_EQ(tick_of(*playback.pop_next(11.0)), 60U);
  EXPECT_EQ(tick_of(*playback.pop_next(11.0)), 61U);
  EXPECT_FALSE(playback.pop_next(11.0));
}

TEST(Playback, chunks_of_a_join_pass_at_once) {
  Playback playback;
  playback.start(WelcomeMessage{});
  push(playback, ChunkMessage{}, 5.0);
  EXPECT_EQ(pop_due(playback, 5.0).size(), 1U);
}

TEST(Playback, clock_never_runs_backwards_nor_on_without_frames_for_long) {
  Playback playback;
  playback.start(WelcomeMessage{});
  double last = -10.0;
  for (Tick tick = 1; tick <= 200; ++tick) {
    const double jitter_s = tick % 7 == 0 ? 0.08 : 0.0;
    const double now_s = 50.0 + static_cast<double>(tick) / 60.0 + jitter_s;
    push(playback, frame(tick), now_s);
    pop_due(playback, now_s);
    const double draw = playback.draw_tick(now_s);
    EXPECT_GE(draw, last);
    EXPECT_LE(draw, static_cast<double>(tick));
    last = draw;
  }
  EXPECT_LE(playback.draw_tick(1000.0), 200.0 + limits::playback_quiet_s * 60.0);
}

TEST(Playback, holds_no_more_messages_back_than_its_limit) {
  Playback playback;
  playback.start(WelcomeMessage{});
  push(playback, frame(60), 10.0);
  for (size_t i = 1; i < limits::playback_messages_max; ++i) push(playback, StatusMessage{}, 10.0);
  EXPECT_TRUE(pop_due(playback, 10.0).empty()) << "all wait behind the frame";
  push(playback, StatusMessage{}, 10.0);
  EXPECT_EQ(pop_due(playback, 10.0).size(), limits::playback_messages_max + 1);
}

TEST(Playback, goes_on_after_a_jump_of_the_server) {
  Playback playback;
  playback.start(WelcomeMessage{});
  push(playback, frame(10000), 1.0);
  EXPECT_EQ(pop_due(playback, 1.5).size(), 1U);
  push(playback, frame(20), 2.0);
  EXPECT_EQ(pop_due(playback, 2.5).size(), 1U);
}

TEST(Playback, the_first_can_be_had_before_it_is_due) {
  Playback playback;
  playback.start(WelcomeMessage{});
  push(playback, frame(60), 10.0);
  push(playback, StatusMessage{}, 10.0);
  EXPECT_FALSE(playback.pop_next(10.0));
  EXPECT_EQ(tick_of(*playback.take_first()), 60U);
  EXPECT_TRUE(std::holds_alternative<StatusMessage>(playback.take_first()->message));
  EXPECT_FALSE(playback.take_first());
}

}  // namespace
}  // namespace scree
