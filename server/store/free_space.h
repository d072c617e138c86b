// The room that is left where a file lies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace scree {

/// Bytes that this process may still write there; 0 where the system does not say. It asks the disk.
inline uint64_t free_bytes_at(const std::string& path) {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::absolute(path, error);
  const auto space = std::filesystem::space(file.parent_path(), error);
  return error ? 0 : space.available;
}

}  // namespace scree
