#include "client/viewer/base/files.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "client/viewer/base/limits.h"
#include "shared/base/regular_file.h"

namespace scree {

Result<std::string> read_text(const std::string& file) {
  Result<std::string> text = read_bytes_of(file, limits::text_file_bytes_max);
  if (!text) return fail(file + ": " + text.error().message);
  if (text->size() > limits::text_file_bytes_max)
    return fail(file + " is over " + std::to_string(limits::text_file_bytes_max) +
                " bytes (limits.text_file_bytes_max)");
  return text;
}

Result<void> write_text(const std::string& file, const std::string& text) {
  const std::filesystem::path path(file);
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error) return fail(file + " cannot be written: " + error.message());
  const std::string partial = file + ".partial";
  errno = 0;
  {
    std::ofstream out(partial, std::ios::binary | std::ios::trunc);
    out << text;
    out.close();
    if (!out) return fail(file + " cannot be written: " + std::strerror(errno));
  }
  std::filesystem::rename(partial, file, error);
  if (error) return fail(file + " cannot be written: " + error.message());
  return {};
}

}  // namespace scree
