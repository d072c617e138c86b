// What one build keeps between runs is not used by another.
#include "studies/support/this_build.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace scree {
namespace {

TEST(ThisBuild, is_the_same_each_time) {
  EXPECT_EQ(this_build(), this_build());
  EXPECT_GE(this_build().size(), 8U);
}

TEST(BuildFolder, keeps_what_the_same_build_made_and_nothing_of_others) {
  const TestFolder folder;
  const std::string kept = folder / "kept";
  std::string first;
  {
    const auto taken = BuildFolder::acquire(kept, "a");
    ASSERT_TRUE(taken) << taken.error().message;
    first = taken->path();
    std::ofstream(first + "/world") << "of a";
    std::ofstream(kept + "/world") << "of none";
  }
  {
    const auto again = BuildFolder::acquire(kept, "a");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->path(), first);
    EXPECT_TRUE(std::filesystem::exists(first + "/world"));
    EXPECT_FALSE(std::filesystem::exists(kept + "/world"));
  }
  const auto second = BuildFolder::acquire(kept, "b");
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_TRUE(std::filesystem::is_empty(second->path()));
  EXPECT_FALSE(std::filesystem::exists(first));
}

TEST(BuildFolder, that_a_run_holds_is_neither_removed_nor_taken_twice) {
  const TestFolder folder;
  const auto first = BuildFolder::acquire(folder / "kept", "a");
  ASSERT_TRUE(first) << first.error().message;
  std::ofstream(first->path() + "/world") << "of a";
  const auto other = BuildFolder::acquire(folder / "kept", "b");
  ASSERT_TRUE(other) << other.error().message;
  EXPECT_TRUE(std::filesystem::exists(first->path() + "/world"));
  const auto twice = BuildFolder::acquire(folder / "kept", "a");
  ASSERT_FALSE(twice);
  EXPECT_NE(twice.error().message.find(first->path()), std::string::npos) << twice.error().message;
}

TEST(BuildFolder, that_cannot_be_made_is_an_error) {
  EXPECT_FALSE(BuildFolder::acquire("/proc/none", "a"));
}

}  // namespace
}  // namespace scree
