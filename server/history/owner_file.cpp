#include "server/history/owner_file.h"

#include <filesystem>

namespace scree {

Result<void> let_owner_alone_read(const std::string& path) {
  using std::filesystem::perms;
  std::error_code error;
  std::filesystem::permissions(path, perms::owner_read | perms::owner_write, error);
  return error ? fail(path + ": " + error.message()) : Result<void>();
}

}  // namespace scree
