#include "server/app/load_governor.h"

#include <gtest/gtest.h>
#include <vector>

#include "server/app/limits.h"
#include "server/work/limits.h"

namespace scree {
namespace {

constexpr uint32_t interval_ticks = 30;  ///< ticks, at 60 Hz
static_assert(limits::governor_interval_s * 60 == interval_ticks);

/// What the governor wants after so many looks at ticks of that length.
std::vector<uint32_t> wanted_after(LoadGovernor& governor, uint32_t intervals, double length,
                                   uint32_t percent, uint64_t lost_each_interval = 0) {
  std::vector<uint32_t> wanted;
  for (uint32_t tick = 1; tick <= intervals * interval_ticks; ++tick) {
    const auto want =
        governor.tick_ended(length, tick % interval_ticks == 1 ? lost_each_interval : 0, percent);
    if (!want) continue;
    EXPECT_EQ(tick % interval_ticks, 0U);
    wanted.push_back(percent = *want);
  }
  return wanted;
}

TEST(LoadGovernor, work_is_reduced_while_ticks_are_lost_and_never_below_the_least) {
  LoadGovernor governor(60, 65);
  EXPECT_EQ(wanted_after(governor, 20, 1.2, 65, 6), (std::vector<uint32_t>{52, 41, 32, 25, 20, 16, 15}));
}

TEST(LoadGovernor, ticks_that_are_lost_once_change_nothing) {
  LoadGovernor governor(60, 65);
  EXPECT_EQ(wanted_after(governor, 1, 1.2, 40, 6), std::vector<uint32_t>{});
  EXPECT_EQ(wanted_after(governor, limits::governor_intervals - 1, 1.2, 40), std::vector<uint32_t>{});
  EXPECT_EQ(wanted_after(governor, 1, 1.2, 40, 6), std::vector<uint32_t>{}) << "the first is forgotten";
  EXPECT_EQ(wanted_after(governor, 1, 1.2, 40, 6), std::vector<uint32_t>{32});
}

TEST(LoadGovernor, work_comes_back_in_small_steps_while_no_tick_is_lost) {
  LoadGovernor governor(60, 65);
  EXPECT_EQ(wanted_after(governor, limits::governor_calm_intervals * 4, 0.9, 58),
            (std::vector<uint32_t>{63, 65}));
}

TEST(LoadGovernor, work_comes_back_to_what_was_chosen_and_no_further) {
  LoadGovernor governor(60, 30);
  EXPECT_TRUE(wanted_after(governor, limits::governor_calm_intervals * 4, 0.5, 30).empty());
  EXPECT_EQ(wanted_after(governor, 2, 1.2, 30, 6), std::vector<uint32_t>{24});
  EXPECT_EQ(wanted_after(governor, limits::governor_calm_intervals * 4, 0.5, 24),
            (std::vector<uint32_t>{29, 30}));
  governor.chosen(40);
  EXPECT_EQ(wanted_after(governor, limits::governor_calm_intervals * 4, 0.5, 30),
            (std::vector<uint32_t>{35, 40}));
}

TEST(LoadGovernor, late_ticks_that_are_caught_up_with_change_nothing) {
  LoadGovernor governor(60, 65);
  for (uint32_t tick = 0; tick < 20 * interval_ticks; ++tick)
    EXPECT_FALSE(governor.tick_ended(tick % 3 == 0 ? 1.5 : 0.5, 0, 40)) << tick;
}

TEST(LoadGovernor, slow_ticks_are_looked_at_two_at_a_time) {
  LoadGovernor governor(1, 65);
  EXPECT_FALSE(governor.tick_ended(2.0, 1, 65));
  EXPECT_FALSE(governor.tick_ended(2.0, 0, 65));
  EXPECT_FALSE(governor.tick_ended(2.0, 1, 65));
  EXPECT_EQ(governor.tick_ended(2.0, 0, 65), 52U);
}

}  // namespace
}  // namespace scree
