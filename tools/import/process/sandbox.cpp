#include "tools/import/process/sandbox.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "shared/base/small_letters.h"
#include "tools/import/process/limits.h"
#include "tools/import/process/system_calls.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

/// Rights of Landlock's third and fifth version, which older headers lack.
constexpr uint64_t right_to_truncate = uint64_t{1} << 14U, right_to_control_devices = uint64_t{1} << 15U;
constexpr uint64_t right_to_refer = uint64_t{1} << 13U;
constexpr uint64_t first_rights = right_to_refer - 1;
constexpr int version_of_refer = 2, version_of_truncate = 3, version_of_control = 5;

constexpr std::array system_folders = {"/usr/lib",         "/usr/lib32",     "/usr/lib64", "/usr/share",
                                       "/usr/local/share", "/usr/local/lib", "/lib",       "/lib64"};
constexpr std::array system_variables = {"GDAL_DATA", "PROJ_DATA", "PROJ_LIB"};

/// 0: the kernel has none.
int landlock_version() {
  const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  return version > 0 ? static_cast<int>(version) : 0;
}

/// Everything that Landlock knows is refused, but for reading below the places that are allowed.
class FileWall {
 public:
  explicit FileWall(int version) {
    landlock_ruleset_attr rules{};
    rules.handled_access_fs = first_rights;
    if (version >= version_of_refer) rules.handled_access_fs |= right_to_refer;
    if (version >= version_of_truncate) rules.handled_access_fs |= right_to_truncate;
    if (version >= version_of_control) rules.handled_access_fs |= right_to_control_devices;
    rules_ = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &rules, sizeof rules, 0));
  }
  ~FileWall() {
    if (rules_ >= 0) ::close(rules_);
  }
  FileWall(const FileWall&) = delete;
  FileWall& operator=(const FileWall&) = delete;

  /// A place that is not there is no way around the wall.
  void allow_file(const std::string& path) { allow(path, O_PATH, LANDLOCK_ACCESS_FS_READ_FILE); }
  void allow_folder(const std::string& path) {
    allow(path, O_PATH | O_DIRECTORY, LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR);
  }
  bool raise() {
    return rules_ >= 0 && ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           ::syscall(SYS_landlock_restrict_self, rules_, 0) == 0;
  }

 private:
  void allow(const std::string& path, int how, uint64_t rights) const {
    const int place = ::open(path.c_str(), how | O_CLOEXEC);
    if (place < 0) return;
    landlock_path_beneath_attr below{};
    below.allowed_access = rights;
    below.parent_fd = place;
    ::syscall(SYS_landlock_add_rule, rules_, LANDLOCK_RULE_PATH_BENEATH, &below, 0);
    ::close(place);
  }

  int rules_ = -1;
};

Result<void> wall_off_files(const Readable& readable) {
  const int version = landlock_version();
  if (version == 0) return {};
  FileWall wall(version);
  for (const char* const folder : system_folders) wall.allow_folder(folder);
  for (const char* const name : system_variables)
    if (const char* const folder = std::getenv(name); folder != nullptr) wall.allow_folder(folder);
  for (const std::string& file : readable.files) wall.allow_file(file);
  for (const std::string& folder : readable.folders) wall.allow_folder(folder);
  if (wall.raise()) return {};
  return fail(std::string("its reader cannot be confined: ") + std::strerror(errno));
}

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

}  // namespace

Readable file_and_its_namesakes(const std::string& path) {
  Readable readable{.files = {path}};
  const std::string stem = in_small_letters(fs::path(path).stem().string());  // as GDAL compares them
  std::error_code error;
  for (fs::directory_iterator at(folder_of(path), error), end; !error && at != end; at.increment(error)) {
    const std::string name = in_small_letters(at->path().filename().string());
    std::error_code ignored;
    const bool is_beside = name == stem || name.starts_with(stem + ".");
    // A link may lead anywhere.
    if (!is_beside || at->is_symlink(ignored) || !at->is_regular_file(ignored)) continue;
    if (readable.files.size() < limits::reader_files_max) readable.files.push_back(at->path().string());
  }
  return readable;
}

Readable file_and_its_folder(const std::string& path) {
  return {.files = {path}, .folders = {folder_of(path)}};
}

Result<void> enter_sandbox(const Readable& readable) {
  TRY(wall_off_files(readable));
  return filter_system_calls();
}

std::string missing_walls() {
  const bool files = landlock_version() > 0, calls = has_filters();
  if (files && calls) return {};
  return std::string("this kernel has no ") +
         (files   ? "filters of system calls"
          : calls ? "Landlock"
                  : "Landlock and no filters of system calls") +
         ": a library that a foreign file deceives is not walled off; only its forms and names are checked";
}

}  // namespace scree
