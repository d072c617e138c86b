// What programs are told by their options is refused before they begin.
#include "shared/base/option_check.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/holds.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

TEST(OptionCheck, numbers_are_finite_whole_where_they_must_be_and_within_their_bounds) {
  const NumberWithin number{0.15F, 2.0};
  for (const char* good : {"0.15", "2", "1e0", "1.999"}) EXPECT_EQ(number(good), "") << good;
  for (const char* bad : {"nan", "inf", "-nan", "0.1499", "2.001", "", "1x", " 1", "one"})
    EXPECT_NE(number(bad), "") << bad;
  EXPECT_EQ(number("nan"), "'nan' is not a number, 0.15 to 2");
  const NumberWithin port = whole_within(1, 65535);
  for (const char* good : {"1", "65535"}) EXPECT_EQ(port(good), "") << good;
  for (const char* bad : {"0", "-1", "65536", "1.5", "nan"}) EXPECT_NE(port(bad), "") << bad;
  EXPECT_EQ(port("-1"), "'-1' is not a whole number, 1 to 65535");
}

TEST(OptionCheck, a_file_that_cannot_be_written_is_named_and_nothing_is_left_behind) {
  const TestFolder folder;
  const std::string fresh = folder / "report.json";
  EXPECT_TRUE(can_be_written(fresh));
  EXPECT_FALSE(std::filesystem::exists(fresh));
  std::ofstream(fresh) << "kept";
  EXPECT_TRUE(can_be_written(fresh));
  EXPECT_EQ(std::filesystem::file_size(fresh), 4U);
  const std::string lost = folder / "no/such/folder/report.json";
  EXPECT_TRUE(holds(check_writable(lost), lost + " cannot be written: No such file or directory"));
  EXPECT_EQ(check_writable(fresh), "");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(holds(check_replaceable(folder / "pipe"), "it is a pipe"));
  EXPECT_TRUE(holds(check_replaceable("/dev/full"), "it is a device"));
  EXPECT_EQ(check_replaceable(fresh), "");
  EXPECT_TRUE(holds(check_writable(folder / "pipe"), "it is a pipe")) << "an open would wait for its reader";
}

}  // namespace
}  // namespace scree
