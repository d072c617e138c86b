// Tiles of elevation models as files, each named by its SHA-256: a tile is what its name says, or is as none,
// whatever server it is from. They lie beside the chunks (cache_folder.h), which bounds all files together.
// It is only a cache: a file that cannot be written or read is as none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shared/base/digest.h"

namespace scree {

inline constexpr const char* tile_extension = ".tile";

class TileFolder {
 public:
  /// `path` is empty: nothing is read or written.
  explicit TileFolder(std::string path) : path_(std::move(path)) {}

  std::optional<std::vector<uint8_t>> read(const Digest& digest) const;
  void write(const Digest& digest, const std::vector<uint8_t>& bytes) const;

 private:
  std::string path_;
};

/// Whether a file of that name is a tile.
bool is_tile_name(const std::string& name);

}  // namespace scree
