#include "server/store/world_upgrade.h"

#include <filesystem>
#include <fmt/format.h>

#include "server/store/limits.h"
#include "server/store/world_copy.h"

namespace scree {

std::string name_of_older(const std::string& path, int number) {
  const std::string first = fmt::format("{}.before-v{}", path, world_format);
  return number == 1 ? first : fmt::format("{}-{}", first, number);
}

Result<void> keep_older_world(const std::string& path) {
  const auto standing = TRY(check_world(path, WorldCheck::moment));
  for (int number = 1; number <= limits::older_worlds_max; ++number) {
    const std::string name = name_of_older(path, number);
    std::error_code ignored;
    if (!std::filesystem::exists(name, ignored)) {
      TRY(copy_checked(path, name, WorldCheck::moment));
      return {};
    }
    if (const auto there = check_world(name, WorldCheck::moment); there && *there == standing) return {};
  }
  return fail(
      fmt::format("{}: there are {} copies of it before format {} already: move some away "
                  "(limits.older_worlds_max)",
                  path, limits::older_worlds_max, world_format));
}

}  // namespace scree
