#include "tools/rules/written_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace scree {

Result<void> write_new_file(const std::string& path, std::string_view text, Existing existing) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (existing == Existing::refused && fs::exists(path, error)) return fail(path + " is there already");
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) return fail(folder.string() + " cannot be made: " + error.message());
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) return fail(path + " cannot be written: " + std::strerror(errno));
  return {};
}

}  // namespace scree
