#include "server/app/temporary_world.h"

#include <atomic>
#include <filesystem>
#include <unistd.h>
#include <vector>

#include "server/store/world_lock.h"
#include "shared/base/xdg_folder.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

constexpr const char* prefix = "paged-";
constexpr const char* suffix = ".world";

/// Files that processes left behind: who holds a world's lock is alive.
void remove_left_behind(const fs::path& folder) {
  std::error_code ignored;
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(prefix) && name.ends_with(suffix)) found.push_back(entry.path().string());
  }
  for (const std::string& path : found)
    if (const auto lock = WorldLock::acquire(path)) remove_world(path);
}

}  // namespace

Result<std::string> temporary_world_path() {
  static std::atomic<uint32_t> made{0};
  std::error_code error;
  fs::path folder = xdg_folder("XDG_CACHE_HOME", ".cache");
  if (folder.empty() || (fs::create_directories(folder, error), access(folder.c_str(), W_OK) != 0))
    folder = fs::temp_directory_path(error);
  if (folder.empty() || access(folder.c_str(), W_OK) != 0)
    return fail(
        "there is no folder for a temporary world: name a file for the world (--world), or set "
        "XDG_CACHE_HOME or TMPDIR");
  remove_left_behind(folder);
  return (folder / (prefix + std::to_string(getpid()) + "-" + std::to_string(++made) + suffix)).string();
}

void remove_world(const std::string& path) {
  std::error_code ignored;
  for (const char* part :
       {"", "-wal", "-shm", "-journal", "-new", "-lock", ".history", ".history-wal", ".history-shm"})
    fs::remove(path + part, ignored);
}

}  // namespace scree
