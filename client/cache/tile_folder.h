// Tiles of elevation models, palettes and images as files, each named by its SHA-256: a file is what its name
// says, or is as none, whatever server it is from. They lie beside the chunks (cache_folder.h), which bounds
// all files together. It is only a cache: a file that cannot be written or read is as none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/limits.h"
#include "shared/base/digest.h"

namespace scree {

inline constexpr const char* tile_extension = ".tile";
inline constexpr const char* content_extension = ".content";

class TileFolder {
 public:
  /// `path` is empty: nothing is read or written. `extension`: of the files' names; `bytes_max`: of one.
  explicit TileFolder(std::string path, const char* extension = tile_extension,
                      size_t bytes_max = limits::tile_bytes_max)
      : path_(std::move(path)), extension_(extension), bytes_max_(bytes_max) {}

  std::optional<std::vector<uint8_t>> read(const Digest& digest) const;
  void write(const Digest& digest, const std::vector<uint8_t>& bytes) const;

 private:
  std::string path_;
  const char* extension_;
  size_t bytes_max_;
};

/// Whether a file of that name is one of such a folder.
bool is_tile_name(const std::string& name, const std::string& extension = tile_extension);

}  // namespace scree
