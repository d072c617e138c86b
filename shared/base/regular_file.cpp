#include "shared/base/regular_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace scree {

namespace {

const char* words_on(std::filesystem::file_type type) {
  switch (type) {
    case std::filesystem::file_type::directory:
      return "it is a folder, not a file";
    case std::filesystem::file_type::fifo:
      return "it is a pipe, not a file";
    case std::filesystem::file_type::socket:
      return "it is a socket, not a file";
    case std::filesystem::file_type::not_found:
      return "there is no such file";
    default:
      return "it is a device, not a file";
  }
}

}  // namespace

Result<void> check_is_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (error && status.type() == std::filesystem::file_type::none) return fail("it cannot be reached");
  if (status.type() == std::filesystem::file_type::regular) return {};
  return fail(words_on(status.type()));
}

Result<void> check_is_small_file(const std::string& path, size_t bytes_max) {
  if (const auto checked = check_is_file(path); !checked) return fail(path + ": " + checked.error().message);
  std::error_code error;
  if (const auto bytes = std::filesystem::file_size(path, error); !error && bytes > bytes_max)
    return fail(path + ": a file of " + std::to_string(bytes >> 10U) +
                " KiB is not what is wanted here, at most " + std::to_string(bytes_max >> 10U) + " KiB");
  return {};
}

Result<void> check_no_device(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error) || error) return {};
  if (const auto checked = check_is_file(path); !checked) return fail(path + ": " + checked.error().message);
  return {};
}

Result<void> replace_file(const std::string& path, std::string_view text) {
  TRY(check_no_device(path));
  struct stat before {};
  const bool was_there = ::lstat(path.c_str(), &before) == 0 && S_ISREG(before.st_mode);
  const std::string fresh = path + ".new";
  // Whatever lies there is from a program that was ended meanwhile, or a link to a file of somebody's.
  static_cast<void>(::unlink(fresh.c_str()));
  const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) return fail(path + " cannot be written: " + std::strerror(errno));
  bool done = !was_there || ::fchmod(file, before.st_mode & 07777U) == 0;
  while (done && !text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    done = count > 0;
    if (done) text.remove_prefix(static_cast<size_t>(count));
  }
  done = done && ::fsync(file) == 0;
  int error = errno;
  ::close(file);
  if (done && ::rename(fresh.c_str(), path.c_str()) != 0) done = false, error = errno;
  if (done) return {};
  static_cast<void>(::unlink(fresh.c_str()));
  return fail(path + " cannot be written: " + std::strerror(error));
}

}  // namespace scree
