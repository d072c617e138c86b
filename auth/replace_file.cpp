#include "auth/replace_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "shared/base/regular_file.h"

namespace scree {

namespace {

/// All of it, on the disk.
bool written(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    if (count <= 0) return false;
    text.remove_prefix(static_cast<size_t>(count));
  }
  return ::fsync(file) == 0;
}

}  // namespace

Result<void> replace_file(const std::string& path, std::string_view text, unsigned mode) {
  TRY(check_no_device(path));
  struct stat before {};
  const bool was_there = ::lstat(path.c_str(), &before) == 0 && S_ISREG(before.st_mode);
  const std::string fresh = path + ".new";
  // It is from a program that was ended meanwhile, or a link to a file of somebody's.
  static_cast<void>(::unlink(fresh.c_str()));
  const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (file < 0) return fail(path + " cannot be written: " + std::strerror(errno));
  bool done = (!was_there || ::fchmod(file, before.st_mode & 07777U) == 0) && written(file, text);
  int error = errno;
  ::close(file);
  if (done && ::rename(fresh.c_str(), path.c_str()) != 0) done = false, error = errno;
  if (done) return {};
  static_cast<void>(::unlink(fresh.c_str()));
  return fail(path + " cannot be written: " + std::strerror(error));
}

}  // namespace scree
