// What happens to the file of a server and passes again: another program holds it, the disk is full, fails,
// or may not be written, or somebody removes the file.
#pragma once

#include <filesystem>
#include <gtest/gtest.h>
#include <memory>
#include <ostream>
#include <string>

#include "server/store/database.h"
#include "tests/store/faulty_disk.h"

namespace scree {

enum class Fault { held, full, broken, read_only, removed };

inline std::string name_of_fault(const ::testing::TestParamInfo<Fault>& info) {
  static constexpr std::array names{"held", "full", "broken", "read_only", "removed"};
  return names.at(static_cast<size_t>(info.param));
}

/// From its construction to pass().
class PassingFault {
 public:
  PassingFault(Fault fault, FaultyDisk& disk, const std::string& path) : disk_(disk) {
    disk_.full = fault == Fault::full;
    disk_.broken = fault == Fault::broken;
    disk_.read_only = fault == Fault::read_only;
    if (fault == Fault::removed)
      for (const char* end : {"", "-wal", "-shm"}) std::filesystem::remove(path + end);
    if (fault != Fault::held) return;
    auto opened = Database::open(path);
    EXPECT_TRUE(opened && opened->execute("BEGIN EXCLUSIVE").has_value());
    if (opened) holder_ = std::make_unique<Database>(std::move(*opened));
  }
  void pass() {
    disk_.full = disk_.broken = disk_.read_only = false;
    if (holder_) static_cast<void>(holder_->execute("COMMIT"));
    holder_.reset();
  }

 private:
  FaultyDisk& disk_;
  std::unique_ptr<Database> holder_;
};

}  // namespace scree
