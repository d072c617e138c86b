// Where a client keeps files, as its environment and its options say.
#include "client/cache/cache_options.h"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace scree {
namespace {

class CacheOptionsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ::unsetenv("SCREE_CACHE");
    ::unsetenv("SCREE_CACHE_MIB");
    ::setenv("XDG_CACHE_HOME", "/var/caches", 1);
  }
  static CacheConfig parsed(const std::string& arguments, size_t mib) {
    CacheConfig config;
    CLI::App app;
    CacheOptions options(app, config, mib);
    app.parse(arguments);
    options.complete();
    return config;
  }
};

TEST_F(CacheOptionsTest, the_folder_is_xdgs_or_in_the_home_unless_it_is_given) {
  EXPECT_EQ(parsed("", 1).folder, "/var/caches/scree");
  EXPECT_EQ(parsed("--cache /elsewhere", 1).folder, "/elsewhere");
  ::setenv("SCREE_CACHE", "/by/environment", 1);
  EXPECT_EQ(parsed("", 1).folder, "/by/environment");
  ::unsetenv("SCREE_CACHE");
  ::setenv("XDG_CACHE_HOME", "not/absolute", 1);
  const char* home = std::getenv("HOME");
  const std::string before = home == nullptr ? "" : home;
  ::setenv("HOME", "/home/ann", 1);
  EXPECT_EQ(parsed("", 1).folder, "/home/ann/.cache/scree");
  ::setenv("HOME", before.c_str(), 1);
}

TEST_F(CacheOptionsTest, a_bound_of_nothing_means_no_files) {
  EXPECT_EQ(parsed("--cache-mib 3", 1).bytes_max, size_t{3} << 20U);
  EXPECT_EQ(parsed("--cache-mib 0", 1).folder, "");
  EXPECT_EQ(parsed("", 0).folder, "");
  EXPECT_GT(parsed("", 0).bytes_max, 0U) << "what is in memory is for lost connections";
  EXPECT_THROW(parsed("--cache-mib 99999", 1), CLI::ValidationError);
}

TEST_F(CacheOptionsTest, a_folder_in_which_nothing_can_be_kept_is_named) {
  const TestFolder folder;
  const auto tried = [](const std::string& path) {
    CacheConfig config;
    CLI::App app;
    CacheOptions options(app, config, 1);
    app.parse("--cache " + path);
    options.complete();
    const Result<void> usable = options.try_folder();
    return usable ? std::string() : usable.error().message;
  };
  EXPECT_EQ(tried(folder / "new/folder"), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "new/folder"));
  std::ofstream(folder / "file") << "no folder";
  for (const char* path : {"file", "file/below"})
    EXPECT_NE(tried(folder / path).find(folder / path), std::string::npos) << path;
}

}  // namespace
}  // namespace scree
