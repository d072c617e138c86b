// The lines that a console keeps.
#include "client/admin/console/line_history.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "client/admin/console/limits.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

using Lines = std::vector<std::string>;

std::string text_at(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

unsigned mode_at(const std::string& path) {
  struct stat there {};
  return ::stat(path.c_str(), &there) == 0 ? there.st_mode & 07777 : 0;
}

TEST(LineHistory, is_there_again_for_its_person_alone) {
  const TestFolder folder;
  const std::string path = folder / "state/scree/admin_history";
  LineHistory first(path);
  EXPECT_TRUE(first.add("sessions"));
  EXPECT_TRUE(first.add("kick 3"));
  EXPECT_TRUE(first.add("kick 3")) << "but once";
  LineHistory beside(path);
  EXPECT_TRUE(beside.add("status"));
  EXPECT_TRUE(first.add("bans"));
  EXPECT_EQ(LineHistory(path).lines(), (Lines{"sessions", "kick 3", "status", "bans"}));
  EXPECT_EQ(mode_at(path), 0600U);
  EXPECT_EQ(mode_at(folder / "state/scree"), 0700U);
  ::chmod(path.c_str(), 0644);
  beside.add("show");
  EXPECT_EQ(mode_at(path), 0600U) << "it may have been made by others";
}

TEST(LineHistory, keeps_no_line_with_a_secret_and_none_that_cannot_be_shown) {
  const TestFolder folder;
  LineHistory history(folder / "h");
  for (const char* const line :
       {"sessions --token abc", "--TOKEN-file x sessions", "status scree1.AAAA", "a\x1B[2J", "a\nb", ""})
    EXPECT_FALSE(history.add(line)) << line;
  EXPECT_FALSE(history.add(std::string(limits::typed_line_bytes_max + 1, 'x')));
  EXPECT_TRUE(history.lines().empty());
  EXPECT_EQ(mode_at(folder / "h"), 0U);
  std::ofstream(folder / "h") << "status\nsessions --token abc\nbans";
  EXPECT_EQ(LineHistory(folder / "h").lines(), (Lines{"status", "bans"})) << "nor takes one from its file";
}

TEST(LineHistory, forgets_the_oldest_and_leaves_other_files_alone) {
  const TestFolder folder;
  const std::string path = folder / "h";
  {
    std::ofstream file(path);
    for (size_t i = 0; i <= 2 * limits::typed_lines_kept; ++i) file << "carve " << i << '\n';
  }
  const LineHistory history(path);
  ASSERT_EQ(history.lines().size(), limits::typed_lines_kept);
  EXPECT_EQ(history.lines().back(), "carve " + std::to_string(2 * limits::typed_lines_kept));
  EXPECT_EQ(LineHistory(path).lines(), history.lines());
  std::filesystem::create_symlink(path, folder / "link");
  const std::string before = text_at(path);
  LineHistory(folder / "link").add("status");
  EXPECT_EQ(text_at(path), before) << "a link is not followed";
  LineHistory at_folder((folder / "").substr(0, (folder / "").size() - 1));
  EXPECT_TRUE(at_folder.add("status"));
  EXPECT_TRUE(LineHistory("").add("status"));
  EXPECT_TRUE(LineHistory("/proc/no/such/h").add("status"));
}

TEST(LineHistory, lies_where_the_environment_says) {
  const char* const home = std::getenv("HOME");
  const std::string before = home == nullptr ? "" : home;
  ::setenv("HOME", "/home/ann", 1);
  EXPECT_EQ(admin_history_path(), "/home/ann/.local/state/scree/admin_history");
  ::setenv("XDG_STATE_HOME", "/state", 1);
  EXPECT_EQ(admin_history_path(), "/state/scree/admin_history");
  ::unsetenv("XDG_STATE_HOME");
  ::unsetenv("HOME");
  EXPECT_EQ(admin_history_path(), "");
  if (home != nullptr) ::setenv("HOME", before.c_str(), 1);
}

}  // namespace
}  // namespace scree
