// Names of one file are told from each other's, however they are written.
#include "shared/base/distinct_files.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace scree {
namespace {

std::string refusal(const std::string& a, const std::string& b) {
  const NamedFile files[] = {{"--world", a, true, true}, {"--events", b, true}};
  const auto distinct = check_distinct(files);
  return distinct ? std::string() : distinct.error().message;
}

TEST(distinct_files, one_file_by_two_names_is_refused_before_it_is_there) {
  TestFolder folder;
  const std::string there = folder / "there", missing = folder / "missing";
  std::ofstream(there) << "x";
  std::filesystem::create_symlink(there, folder / "link");
  EXPECT_NE(refusal(there, folder / "link"), "");
  EXPECT_NE(refusal(there, folder / "./there"), "");
  EXPECT_NE(refusal(missing, folder / "./missing"), "");
  const std::string relative = std::filesystem::relative(missing).string();
  EXPECT_NE(refusal(missing, relative), "") << relative;
  EXPECT_NE(refusal("missing", "./missing"), "");
  EXPECT_EQ(refusal(there, missing), "");
  EXPECT_EQ(refusal("", ""), "");
  EXPECT_EQ(refusal("/dev/null", "/dev/null"), "") << "takes anything";
}

TEST(distinct_files, what_a_database_keeps_beside_it_is_its_own) {
  TestFolder folder;
  for (const char* suffix : {"-wal", "-shm", "-journal", "-lock"})
    EXPECT_NE(refusal(folder / "world", (folder / "world") + suffix), "") << suffix;
  EXPECT_EQ(refusal(folder / "world", folder / "world-events"), "");
  const NamedFile plain[] = {{"--trace", folder / "trace", true}, {"--events", folder / "trace-wal", true}};
  EXPECT_TRUE(check_distinct(plain).has_value());
}

}  // namespace
}  // namespace scree
