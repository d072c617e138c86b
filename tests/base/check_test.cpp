#include "shared/base/check.h"

#include <gtest/gtest.h>

namespace {

TEST(CheckTest, check_is_on_in_every_build_and_names_its_condition) {
  const int voxels = 3;
  EXPECT_DEATH(CHECK(voxels > 3), "check_test.cpp:[0-9]+: CHECK failed: voxels > 3");
}

TEST(CheckTest, check_eq_shows_both_values) {
  const size_t codes = 512;
  EXPECT_DEATH(CHECK_EQ(codes, -7), "CHECK failed: codes == -7 \\(512, -7\\)");
}

TEST(CheckTest, check_eq_compares_integers_by_value_whatever_their_types) {
  EXPECT_DEATH(CHECK_EQ(-1, ~0U), "-1, 4294967295");
  CHECK_EQ(7, size_t{7});
}

TEST(CheckTest, what_holds_passes_and_is_evaluated_once) {
  int evaluated = 0;
  CHECK(++evaluated == 1);
  CHECK_EQ(++evaluated, 2);
  EXPECT_EQ(evaluated, 2);
}

#ifdef SCREE_CHECK_DEBUG
TEST(CheckTest, check_debug_is_on_in_debug_and_sanitizer_builds) {
  const int voxels = 3;
  EXPECT_DEATH(CHECK_DEBUG(voxels > 3), "CHECK failed: voxels > 3");
}
#else
TEST(CheckTest, check_debug_evaluates_nothing_in_release_builds) {
  int evaluated = 0;
  CHECK_DEBUG(++evaluated < 0);
  EXPECT_EQ(evaluated, 0);
}
#endif

}  // namespace
