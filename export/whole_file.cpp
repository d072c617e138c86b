#include "export/whole_file.h"

#include <filesystem>
#include <unistd.h>

namespace scree {

Result<uint64_t> write_whole(const std::string& path,
                             const std::function<Result<void>(const std::string& unfinished)>& write) {
  const std::string unfinished = path + "." + std::to_string(getpid()) + ".unfinished";
  auto written = write(unfinished);
  std::error_code error;
  const uint64_t bytes = written ? std::filesystem::file_size(unfinished, error) : 0;
  if (written && !error) std::filesystem::rename(unfinished, path, error);
  if (written && error) written = fail(error.message());
  if (written) return bytes;
  std::filesystem::remove(unfinished, error);
  return fail(path + ": it cannot be written: " + written.error().message);
}

}  // namespace scree
