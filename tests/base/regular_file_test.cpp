// Places that a command line names and that are no files.
#include "shared/base/regular_file.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/test_folder.h"

namespace scree {
namespace {

TEST(RegularFile, a_pipe_a_device_a_folder_and_nothing_are_told_apart) {
  const TestFolder folder;
  const std::string file = folder / "file", pipe = folder / "pipe", link = folder / "link";
  std::ofstream(file) << "bytes";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_symlink(file, link);
  const auto words = [](const std::string& path) {
    const auto checked = check_is_file(path);
    return checked ? std::string() : checked.error().message;
  };
  EXPECT_EQ(words(file), "");
  EXPECT_EQ(words(link), "");
  EXPECT_EQ(words(pipe), "it is a pipe, not a file");
  EXPECT_EQ(words("/dev/zero"), "it is a device, not a file");
  EXPECT_EQ(words(folder / ""), "it is a folder, not a file");
  EXPECT_EQ(words(folder / "none"), "there is no such file");
  EXPECT_EQ(words(file + "/below"), "there is no such file");
  EXPECT_TRUE(check_no_device(folder / "none"));
  EXPECT_EQ(check_no_device(pipe).error().message, pipe + ": it is a pipe, not a file");
}

TEST(RegularFile, a_small_file_is_no_longer_than_it_may_be) {
  const TestFolder folder;
  std::ofstream(folder / "file") << std::string(4096, 'x');
  EXPECT_TRUE(check_is_small_file(folder / "file", 4096));
  EXPECT_EQ(check_is_small_file(folder / "file", 2048).error().message,
            folder / "file" + ": a file of 4 KiB is not what is wanted here, at most 2 KiB");
  EXPECT_EQ(check_is_small_file(folder / "none", 2048).error().message,
            folder / "none" + ": there is no such file");
}

TEST(RegularFile, what_is_read_shows_that_a_file_is_too_long) {
  const TestFolder folder;
  std::ofstream(folder / "file") << "abcdef";
  EXPECT_EQ(read_bytes_of(folder / "file", 6), "abcdef");
  EXPECT_EQ(read_bytes_of(folder / "file", 4), "abcde");
  EXPECT_EQ(read_bytes_of(folder / "none", 4).error().message, "there is no such file");
}

}  // namespace
}  // namespace scree
