#include "ground/whole_file.h"

#include <filesystem>
#include <unistd.h>

namespace scree {

namespace {

/// Is removed, unless it has its own name by then: also when `write` throws.
struct Unfinished {
  std::string path;

  ~Unfinished() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

}  // namespace

std::string unfinished_name(const std::string& path) {
  return path + "." + std::to_string(getpid()) + ".unfinished";
}

Result<uint64_t> write_whole(const std::string& path,
                             const std::function<Result<void>(const std::string& unfinished)>& write) {
  const Unfinished unfinished{unfinished_name(path)};
  auto written = write(unfinished.path);
  std::error_code error;
  const uint64_t bytes = written ? std::filesystem::file_size(unfinished.path, error) : 0;
  if (written && !error) std::filesystem::rename(unfinished.path, path, error);
  if (written && error) written = fail(error.message());
  if (written) return bytes;
  return fail(path + ": it cannot be written: " + written.error().message);
}

}  // namespace scree
