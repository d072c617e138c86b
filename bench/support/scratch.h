// What benches that write files share: a folder for them, and the clock of the processor.
#pragma once

#include <ctime>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace scree {

/// Seconds of processor time: CLOCK_THREAD_CPUTIME_ID or CLOCK_PROCESS_CPUTIME_ID.
inline double cpu_s(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

/// Files of a bench; gone when it is.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& bench)
      : path_(std::filesystem::temp_directory_path() /
              ("scree_" + bench + "_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace scree
