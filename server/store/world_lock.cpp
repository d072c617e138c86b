#include "server/store/world_lock.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace scree {

namespace {

std::string process_in(int file) {
  std::array<char, 24> text{};
  const ssize_t count = pread(file, text.data(), text.size() - 1, 0);
  const std::string number(text.data(), count > 0 ? static_cast<size_t>(count) : 0);
  if (number.empty() || number.find_first_not_of("0123456789") != std::string::npos) return "another process";
  return "process " + number;
}

/// Whether a file that is open has one name and is no pipe or device: a lock of ours, and nobody's file that
/// somebody linked here to have it overwritten.
bool is_plain(int file) {
  struct stat status {};
  return fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1;
}

}  // namespace

/// By links a file has several paths: all of them lead to the same lock, or are refused.
Result<WorldLock> WorldLock::acquire(const std::string& world_path) {
  std::error_code unknown;  // then the path is as it was given, and opening it says why
  const std::filesystem::path real = std::filesystem::weakly_canonical(world_path, unknown);
  if (!std::filesystem::is_directory(real, unknown) && std::filesystem::hard_link_count(real, unknown) > 1 &&
      !unknown)
    return fail(world_path +
                " has another name, too (a hard link), by which another server might use it: copy it, "
                "and remove one of the names");
  const std::string path = (real.empty() ? world_path : real.string()) + "-lock";
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644);
  if (file < 0 && errno == ELOOP)
    return fail(fmt::format("{}: {} is a link, which may lead to another file: remove it", world_path, path));
  if (file < 0)
    return fail(fmt::format("{}: {} cannot be written ({}): a world needs a folder that can be written",
                            world_path, path, std::strerror(errno)));
  WorldLock lock(file);
  if (!is_plain(file))
    return fail(
        fmt::format("{}: {} is no plain file, or has another name, too: remove it", world_path, path));
  if (flock(file, LOCK_EX | LOCK_NB) != 0)
    return fail(fmt::format("{} is in use by {}: a world belongs to one server at a time", world_path,
                            process_in(file)));
  const std::string number = std::to_string(getpid());
  // The number is a hint for people: a full disk does not keep a world from its server.
  const bool is_told = ftruncate(file, 0) == 0 && pwrite(file, number.data(), number.size(), 0) >= 0;
  static_cast<void>(is_told);
  return lock;
}

WorldLock::~WorldLock() {
  if (file_ >= 0) close(file_);
}

WorldLock::WorldLock(WorldLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

WorldLock& WorldLock::operator=(WorldLock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

}  // namespace scree
