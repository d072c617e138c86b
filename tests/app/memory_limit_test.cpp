// How much memory a process may have, by files as Linux has them.
#include "server/app/memory_limit.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

class MemoryLimit : public ::testing::Test {
 protected:
  void write(const std::string& path, const std::string& text) {
    fs::create_directories(fs::path(root() + path).parent_path());
    std::ofstream(root() + path) << text << "\n";
  }
  std::string root() const { return folder / "root"; }

  const TestFolder folder;
};

TEST_F(MemoryLimit, is_the_machine_s_where_no_group_has_one) {
  EXPECT_EQ(memory_limit_bytes(root()), 0.0) << "the system says nothing";
  write("/proc/meminfo", "MemTotal:       1000 kB\nMemFree:  1 kB");
  write("/proc/self/cgroup", "0::/scree.slice/a.service");
  write("/sys/fs/cgroup/scree.slice/a.service/memory.max", "max");
  EXPECT_EQ(memory_limit_bytes(root()), 1024'000.0);
}

TEST_F(MemoryLimit, is_the_least_of_all_groups_above) {
  write("/proc/meminfo", "MemTotal:       1000 kB");
  write("/proc/self/cgroup", "0::/scree.slice/a.service");
  write("/sys/fs/cgroup/scree.slice/a.service/memory.max", "900000");
  write("/sys/fs/cgroup/scree.slice/memory.max", "500000");
  EXPECT_EQ(memory_limit_bytes(root()), 500'000.0);
}

TEST_F(MemoryLimit, is_read_at_the_top_within_a_container) {
  write("/proc/meminfo", "MemTotal:       1000 kB");
  write("/proc/self/cgroup", "0::/docker/0123");
  write("/sys/fs/cgroup/memory.max", "700000");
  EXPECT_EQ(memory_limit_bytes(root()), 700'000.0);
}

TEST_F(MemoryLimit, is_that_of_the_older_groups_too) {
  write("/proc/meminfo", "MemTotal:       1000 kB");
  write("/proc/self/cgroup", "5:cpu:/a\n4:hugetlb,memory:/a\n1:name=systemd:/a");
  write("/sys/fs/cgroup/memory/a/memory.limit_in_bytes", "300000");
  write("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712");
  EXPECT_EQ(memory_limit_bytes(root()), 300'000.0);
}

TEST(MemoryLimitHere, is_something) {
  EXPECT_GT(memory_limit_bytes(), 64e6);
}

}  // namespace
}  // namespace scree
