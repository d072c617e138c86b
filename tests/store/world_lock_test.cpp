// The lock that keeps a world to one process.
#include "server/store/world_lock.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/stat.h>
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

TEST(WorldLock, does_not_write_into_a_file_that_was_linked_in_its_place) {
  const TestFolder folder;
  const std::string victim = folder / "victim", path = folder / "world";
  std::ofstream(path) << "a world";
  std::ofstream(victim) << "precious";
  const auto content = [&] {
    std::ifstream file(victim);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  std::filesystem::create_symlink(victim, path + "-lock");
  const auto by_link = WorldLock::acquire(path);
  ASSERT_FALSE(by_link.has_value());
  EXPECT_NE(by_link.error().message.find("is a link"), std::string::npos) << by_link.error().message;
  EXPECT_EQ(content(), "precious");
  std::filesystem::remove(path + "-lock");
  std::filesystem::create_hard_link(victim, path + "-lock");
  const auto by_name = WorldLock::acquire(path);
  ASSERT_FALSE(by_name.has_value());
  EXPECT_NE(by_name.error().message.find("no plain file"), std::string::npos) << by_name.error().message;
  EXPECT_EQ(content(), "precious");
  std::filesystem::remove(path + "-lock");
  ASSERT_EQ(mkfifo((path + "-lock").c_str(), 0600), 0);
  EXPECT_FALSE(WorldLock::acquire(path).has_value()) << "a pipe";
}

}  // namespace
}  // namespace scree
