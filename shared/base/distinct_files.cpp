#include "shared/base/distinct_files.h"

#include <filesystem>
#include <vector>

namespace scree {

namespace {

namespace fs = std::filesystem;

bool is_one_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::exists(a, error) && fs::exists(b, error))
    return fs::equivalent(a, b, error) && (fs::is_regular_file(a, error) || fs::is_directory(a, error));
  const auto whole = [&error](const std::string& path) {
    const fs::path absolute = fs::absolute(path, error);
    return error ? absolute : fs::weakly_canonical(absolute, error);
  };
  const fs::path one = whole(a);
  if (error) return a == b;
  const fs::path other = whole(b);
  return error ? a == b : one == other;
}

/// The file's names, with those that SQLite and locks (server/store) put beside it.
std::vector<std::string> names_of(const NamedFile& file) {
  std::vector<std::string> names{file.path};
  if (file.database)
    for (const char* suffix : {"-wal", "-shm", "-journal", "-lock"}) names.push_back(file.path + suffix);
  return names;
}

bool share_a_name(const NamedFile& a, const NamedFile& b) {
  for (const std::string& one : names_of(a))
    for (const std::string& other : names_of(b))
      if (is_one_file(one, other)) return true;
  return false;
}

}  // namespace

Result<void> check_distinct(std::span<const NamedFile> files) {
  for (size_t i = 0; i < files.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      const NamedFile &a = files[j], &b = files[i];
      if (a.path.empty() || b.path.empty() || (!a.written && !b.written) || !share_a_name(a, b)) continue;
      return fail(a.option + " and " + b.option + " are one file, " + b.path + ": give each its own");
    }
  return {};
}

}  // namespace scree
