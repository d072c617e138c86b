// Temporary folders of benches that were ended.
#include "bench/support/scratch.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

namespace scree {
namespace {

namespace fs = std::filesystem;

fs::path scratch_of(const std::string& bench, pid_t process) {
  return fs::temp_directory_path() / ("scree_" + bench + "_" + std::to_string(process));
}

TEST(ScratchFolder, goes_with_its_bench_and_takes_those_of_ended_processes_along) {
  const std::string bench = "scratch_test_of_" + std::to_string(::getpid());
  const pid_t ended = ::fork();
  if (ended == 0) ::_exit(0);
  ASSERT_GT(ended, 0);
  ASSERT_EQ(::waitpid(ended, nullptr, 0), ended);
  const fs::path left = scratch_of(bench, ended), alive = scratch_of(bench, ::getppid()),
                 other = scratch_of(bench + "_other", ended);
  for (const fs::path& path : {left, alive, other}) fs::create_directories(path / "inner");
  {
    const ScratchFolder folder(bench);
    EXPECT_FALSE(fs::exists(left));
    EXPECT_TRUE(fs::exists(alive)) << "its process lives";
    EXPECT_TRUE(fs::exists(other)) << "of another bench";
    EXPECT_TRUE(fs::exists(scratch_of(bench, ::getpid())));
  }
  EXPECT_FALSE(fs::exists(scratch_of(bench, ::getpid())));
  for (const fs::path& path : {alive, other}) fs::remove_all(path);
}

}  // namespace
}  // namespace scree
