#include "shared/base/check.h"

#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scree {
namespace {

/// A type that says itself how a failed check shows it.
struct Temperature {
  int degrees = 0;
  auto operator<=>(const Temperature&) const = default;
};
std::string check_text(const Temperature& value) {
  return std::to_string(value.degrees) + " degrees";
}

struct Corner {
  int x = 0, y = 0, z = 0;
  bool operator==(const Corner&) const = default;
};
struct Bounds {
  Corner lo, hi;
  bool operator==(const Bounds&) const = default;
};
enum class Colour : uint8_t { red, blue };

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

TEST(CheckTest, every_comparison_shows_both_values) {
  const unsigned some = 3;
  EXPECT_DEATH(CHECK_NE(some, 3), "CHECK failed: some != 3 \\(3, 3\\)");
  EXPECT_DEATH(CHECK_LT(some, 3), "CHECK failed: some < 3 \\(3, 3\\)");
  EXPECT_DEATH(CHECK_LE(some, -1), "CHECK failed: some <= -1 \\(3, -1\\)");
  EXPECT_DEATH(CHECK_GT(-2, some), "CHECK failed: -2 > some \\(-2, 3\\)");
  EXPECT_DEATH(CHECK_GE(2.5F, some), "CHECK failed: 2.5F >= some \\(2.5, 3\\)");
}

TEST(CheckTest, values_of_many_types_are_shown) {
  EXPECT_DEATH(CHECK_EQ(std::string("a"), "b"), "\\(\"a\", \"b\"\\)");
  EXPECT_DEATH(CHECK_EQ(true, false), "\\(true, false\\)");
  EXPECT_DEATH(CHECK_EQ(Colour::red, Colour::blue), "\\(0, 1\\)");
  EXPECT_DEATH(CHECK_EQ(std::optional<int>(), 7), "\\(none, 7\\)");
  EXPECT_DEATH(CHECK_EQ((Corner{1, 2, 3}), Corner()), "\\(\\(1, 2, 3\\), \\(0, 0, 0\\)\\)");
  EXPECT_DEATH(CHECK_EQ((Bounds{{}, {4, 5, 6}}), Bounds()), "\\(0, 0, 0\\) to \\(4, 5, 6\\)");
  EXPECT_DEATH(CHECK_EQ(std::vector<int>(9, 1), std::vector<int>{2}),
               "\\[1, 1, 1, 1, 1, 1, 1, 1, \\.\\.\\.\\], \\[2\\]");
  EXPECT_DEATH(CHECK_NE(std::unique_ptr<int>(), nullptr), "\\(null, null\\)");
  EXPECT_DEATH(CHECK_GE(Temperature{3}, Temperature{4}), "\\(3 degrees, 4 degrees\\)");
}

TEST(CheckTest, a_message_says_what_the_caller_should_have_done) {
  const int wheels = 3;
  EXPECT_DEATH(CHECK(wheels == 4, "mount the fourth"), "CHECK failed: wheels == 4: mount the fourth");
  EXPECT_DEATH(CHECK_EQ(wheels, 4, "mount the fourth"),
               "CHECK failed: wheels == 4 \\(3, 4\\): mount the fourth");
}

TEST(CheckTest, values_too_long_to_show_are_cut) {
  const std::string long_text(10000, 'x');
  EXPECT_DEATH(CHECK_EQ(long_text, "short"), "CHECK failed: long_text == \"short\" \\(\"x{200,240}\\)");
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
}  // namespace scree
