// The lock that keeps a world to one process.
#include "server/store/world_lock.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

#include "tests/support/test_folder.h"

namespace scree {
namespace {

TEST(WorldLock, a_world_belongs_to_one_process_by_whatever_name) {
  const TestFolder folder;
  const std::string path = folder / "world";
  std::ofstream(path) << "a world";
  const auto first = WorldLock::acquire(path);
  ASSERT_TRUE(first.has_value()) << first.error().message;
  const auto second = WorldLock::acquire(path);
  ASSERT_FALSE(second.has_value());
  EXPECT_NE(second.error().message.find("process " + std::to_string(::getpid())), std::string::npos)
      << second.error().message;
  const auto link = folder / "link", twin = folder / "twin";
  std::filesystem::create_symlink(path, link);
  EXPECT_FALSE(WorldLock::acquire(link).has_value()) << "by another name it is the same world";
  std::filesystem::create_hard_link(path, twin);
  const auto by_twin = WorldLock::acquire(twin);
  ASSERT_FALSE(by_twin.has_value());
  EXPECT_NE(by_twin.error().message.find("hard link"), std::string::npos) << by_twin.error().message;
  const auto nowhere = WorldLock::acquire(folder / "no folder/world");
  ASSERT_FALSE(nowhere.has_value());
  EXPECT_NE(nowhere.error().message.find("cannot be written"), std::string::npos);
}

}  // namespace
}  // namespace scree
