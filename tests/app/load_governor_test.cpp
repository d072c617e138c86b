#include "server/app/load_governor.h"

#include <gtest/gtest.h>
#include <vector>

#include "server/app/limits.h"
#include "server/work/limits.h"

namespace scree {
namespace {

constexpr uint32_t a_look = 30;  ///< ticks, at 60 Hz
static_assert(limits::governor_look_s * 60 == a_look);

/// What the governor wants after so many looks at ticks of that length.
std::vector<uint32_t> wanted_after(LoadGovernor& governor, uint32_t looks, double length, uint32_t percent,
                                   uint64_t lost_each_look = 0) {
  std::vector<uint32_t> wanted;
  for (uint32_t tick = 1; tick <= looks * a_look; ++tick) {
    const auto want = governor.tick_ended(length, tick % a_look == 1 ? lost_each_look : 0, percent);
    if (!want) continue;
    EXPECT_EQ(tick % a_look, 0U);
    wanted.push_back(percent = *want);
  }
  return wanted;
}

TEST(LoadGovernor, work_is_reduced_look_by_look_while_ticks_are_late_and_never_below_the_least) {
  LoadGovernor governor(60);
  EXPECT_EQ(wanted_after(governor, 10, 1.2, 65), (std::vector<uint32_t>{52, 41, 32, 25, 20, 16, 15}));
}

TEST(LoadGovernor, a_lost_tick_counts_as_late_whatever_the_others_were) {
  LoadGovernor governor(60);
  EXPECT_EQ(wanted_after(governor, 2, 0.3, 65, 1), (std::vector<uint32_t>{52, 41}));
}

TEST(LoadGovernor, work_comes_back_in_small_steps_while_no_tick_is_late) {
  LoadGovernor governor(60);
  EXPECT_EQ(wanted_after(governor, limits::governor_calm_looks * 4, 0.9, 58),
            (std::vector<uint32_t>{63, 65}));
}

TEST(LoadGovernor, few_late_ticks_change_nothing) {
  LoadGovernor governor(60);
  for (uint32_t tick = 0; tick < 20 * a_look; ++tick)
    EXPECT_FALSE(governor.tick_ended(tick % 15 == 0 ? 1.5 : 0.5, 0, 40)) << tick;
}

TEST(LoadGovernor, slow_ticks_are_looked_at_two_at_a_time) {
  LoadGovernor governor(1);
  EXPECT_FALSE(governor.tick_ended(2.0, 0, 65));
  EXPECT_EQ(governor.tick_ended(2.0, 0, 65), 52U);
}

}  // namespace
}  // namespace scree
