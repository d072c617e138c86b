#include "auth/new_secret.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

#include "auth/base64url.h"
#include "crypto/signing_key.h"

namespace scree {

namespace {

std::string new_secret() {
  // A dash at its start would make an option of it on a command line.
  std::array<uint8_t, 17> bytes{};
  for (size_t at = 1; at < bytes.size(); at += sizeof(uint64_t)) {
    const uint64_t number = random_number();
    std::memcpy(bytes.data() + at, &number, sizeof number);
  }
  return to_base64url(bytes);
}

/// On the disk.
bool written(int file, const std::string& text) {
  const bool whole = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  return whole && ::fsync(file) == 0;
}

}  // namespace

/// Under another name first: a server that is ended meanwhile leaves no file without a token.
Result<void> write_new_secret(const std::string& path) {
  const std::string fresh = path + ".new";
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) return fail("the token's file " + path + " is there already");
  std::filesystem::remove(fresh, ignored);
  const int file = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file < 0) return fail("the token's file " + path + " cannot be made: " + std::strerror(errno));
  bool done = written(file, new_secret() + "\n");
  int error = errno;
  ::close(file);
  if (done && std::rename(fresh.c_str(), path.c_str()) != 0) done = false, error = errno;
  if (done) return {};
  std::filesystem::remove(fresh, ignored);
  return fail("the token's file " + path + " cannot be made: " + std::strerror(error));
}

}  // namespace scree
