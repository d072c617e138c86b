// Files that a server writes anew.
#include "auth/replace_file.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/test_folder.h"

namespace scree {
namespace {

TEST(ReplaceFile, keeps_the_rights_and_writes_through_no_link) {
  const TestFolder folder;
  const std::string file = folder / "file", victim = folder / "victim";
  const auto text_of = [](const std::string& path) {
    std::ifstream in(path);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_TRUE(replace_file(file, "first", 0600));
  EXPECT_EQ(text_of(file), "first");
  ASSERT_EQ(::chmod(file.c_str(), 0640), 0);
  std::ofstream(victim) << "somebody's";
  std::filesystem::create_symlink(victim, file + ".new");
  EXPECT_TRUE(replace_file(file, "second", 0600));
  EXPECT_EQ(text_of(file), "second");
  EXPECT_EQ(text_of(victim), "somebody's");
  struct stat is {};
  ASSERT_EQ(::stat(file.c_str(), &is), 0);
  EXPECT_EQ(is.st_mode & 0777U, 0640U);
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(file + ".new")));
  EXPECT_FALSE(replace_file(folder / "no/such/folder", "x", 0600));
  EXPECT_FALSE(replace_file("/dev/null", "x", 0600)) << "a device stays";
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace scree
