#include "server/app/distinct_files.h"

#include <filesystem>

namespace scree {

namespace {

namespace fs = std::filesystem;

bool is_one_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::exists(a, error) && fs::exists(b, error))
    return fs::equivalent(a, b, error) && (fs::is_regular_file(a, error) || fs::is_directory(a, error));
  const fs::path one = fs::weakly_canonical(a, error);
  if (error) return a == b;
  const fs::path other = fs::weakly_canonical(b, error);
  return error ? a == b : one == other;
}

}  // namespace

Result<void> check_distinct(std::span<const NamedFile> files) {
  for (size_t i = 0; i < files.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      const NamedFile &a = files[j], &b = files[i];
      if (a.path.empty() || b.path.empty() || (!a.written && !b.written) || !is_one_file(a.path, b.path))
        continue;
      return fail(a.option + " and " + b.option + " are one file, " + b.path + ": give each its own");
    }
  return {};
}

}  // namespace scree
