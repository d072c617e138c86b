// When ticks are due: on time, late and made up for, and so late that time is lost.
#include "server/app/tick_schedule.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

using namespace std::chrono_literals;

constexpr TickSchedule::Clock::time_point start{1000s};
constexpr auto period = 10ms;

TEST(tick_schedule, ticks_on_time_are_due_one_period_apart) {
  TickSchedule schedule(start, period);
  EXPECT_EQ(schedule.due(), start);
  for (int tick = 1; tick <= 100; ++tick) {
    const auto delay = schedule.tick_ended(schedule.due() + 10ms);
    EXPECT_FALSE(delay.late);
    EXPECT_EQ(schedule.due(), start + tick * period) << "an early end does not hurry the next";
  }
}

TEST(tick_schedule, a_late_simulation_catches_up_and_loses_nothing) {
  TickSchedule schedule(start, period);
  auto now = start + period + limits::catch_up_ticks_max * period;  // one slow tick
  EXPECT_TRUE(schedule.tick_ended(now).late);
  int made_up = 0;
  while (schedule.due() < now) {
    now += 1ms;  // the ticks after it are quick
    EXPECT_EQ(schedule.tick_ended(now).lost_ticks, 0U);
    ++made_up;
  }
  EXPECT_EQ(made_up, limits::catch_up_ticks_max + 1);
  EXPECT_EQ(schedule.due(), start + (made_up + 1) * period) << "as if nothing had been late";
}

TEST(tick_schedule, what_is_beyond_the_catching_up_is_lost_and_counted) {
  TickSchedule schedule(start, period);
  const auto now = start + period + 100 * period + 3ms;
  const auto delay = schedule.tick_ended(now);
  EXPECT_TRUE(delay.late);
  EXPECT_EQ(delay.lost_ticks, 100U);
  EXPECT_EQ(schedule.due(), now - 3ms);
  EXPECT_EQ(schedule.tick_ended(now).lost_ticks, 0U) << "lost once";
}

}  // namespace
}  // namespace scree
