// The search for the largest load that holds: it ends at a load that fails, wherever it begins.
#include "studies/scale/most_held.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(MostHeld, is_found_from_below_and_from_above) {
  for (const size_t start : {1U, 5U, 20U, 73U, 74U, 400U}) {
    const auto found = most_held({.start = start}, [](size_t load) { return Result<bool>(load <= 73); });
    ASSERT_TRUE(found);
    EXPECT_LE(found->holds, 73U) << start;
    ASSERT_TRUE(found->fails) << "the search ends at a load that fails";
    EXPECT_GT(*found->fails, 73U) << start;
    EXPECT_LE(static_cast<double>(*found->fails - found->holds), 0.06 * 73.0) << start;
  }
}

TEST(MostHeld, nothing_holds_or_everything_does) {
  const auto nothing = most_held({.start = 40}, [](size_t) { return Result<bool>(false); });
  ASSERT_TRUE(nothing);
  EXPECT_EQ(nothing->holds, 0U);
  EXPECT_EQ(nothing->fails, std::optional<size_t>(1));
  const auto all = most_held({.start = 40, .most = 500}, [](size_t) { return Result<bool>(true); });
  ASSERT_TRUE(all);
  EXPECT_FALSE(all->fails);
  EXPECT_GT(all->holds, 384U);
}

TEST(MostHeld, a_load_that_fails_once_is_tried_again) {
  size_t tried = 0;
  const auto found =
      most_held({.start = 10}, [&](size_t load) { return Result<bool>(++tried != 1 && load <= 30); });
  ASSERT_TRUE(found);
  EXPECT_GE(found->holds, 29U);
}

TEST(MostHeld, an_error_ends_the_search) {
  EXPECT_FALSE(most_held({}, [](size_t) { return Result<bool>(fail("no server")); }));
}

}  // namespace
}  // namespace scree
