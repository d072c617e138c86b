#include "studies/support/this_build.h"

#define XXH_INLINE_ALL
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>
#include <xxhash.h>

namespace scree {

namespace {

/// A descriptor with a lock on the file or folder; -1 when another one has it, or it cannot be opened.
int hold(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file >= 0 && ::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  if (file >= 0) ::close(file);
  return -1;
}

bool is_still_at(int file, const std::filesystem::path& path) {
  struct stat held {
  }, there{};
  return ::fstat(file, &held) == 0 && ::stat(path.c_str(), &there) == 0 && held.st_ino == there.st_ino;
}

}  // namespace

std::string this_build() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  XXH3_state_t* state = XXH3_createState();
  XXH3_64bits_reset(state);
  std::vector<char> part(1U << 20U);
  while (program.read(part.data(), static_cast<std::streamsize>(part.size())), program.gcount() > 0)
    XXH3_64bits_update(state, part.data(), static_cast<size_t>(program.gcount()));
  std::ostringstream name;
  name << std::hex << XXH3_64bits_digest(state);
  XXH3_freeState(state);
  return name.str();
}

Result<BuildFolder> BuildFolder::acquire(const std::string& folder, const std::string& build) {
  namespace fs = std::filesystem;
  const fs::path own = fs::path(folder) / build;
  std::error_code error;
  fs::create_directories(own, error);
  if (error) return fail(own.string() + ": " + error.message());
  const int held = hold(own);
  if (held < 0)
    return fail(own.string() + " is in use by another run of this build: have one of them write elsewhere");
  BuildFolder taken(own.string(), held);
  if (!is_still_at(held, own)) return acquire(folder, build);  // another build removed it before it was held
  std::vector<fs::path> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().filename() != build) others.push_back(entry.path());
  for (const fs::path& other : others) {
    const int others_hold = hold(other);
    if (others_hold < 0) continue;
    fs::remove_all(other, error);
    ::close(others_hold);
    if (error) return fail(other.string() + ": " + error.message());
  }
  return taken;
}

BuildFolder::~BuildFolder() {
  if (held_ >= 0) ::close(held_);
}

BuildFolder::BuildFolder(BuildFolder&& other) noexcept
    : path_(std::move(other.path_)), held_(std::exchange(other.held_, -1)) {}

BuildFolder& BuildFolder::operator=(BuildFolder&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(held_, other.held_);
  return *this;
}

}  // namespace scree
