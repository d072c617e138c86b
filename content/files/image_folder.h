// The images that a palette names, from the folder of its file: nothing outside it is read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "shared/base/digest.h"
#include "shared/base/result.h"

namespace scree {

/// The bytes of images by their SHA-256.
using ImageFiles = std::map<Digest, std::vector<uint8_t>>;

/// One thread.
class ImageFolder {
 public:
  explicit ImageFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Reads an image, `path` from the folder on. Refuses a path that leads out of it, also by a link, what is
  /// no regular file, no PNG, damaged, or beyond the limits of shared/material/material_image.h. The error
  /// names the path and the limit.
  Result<Digest> read(const std::string& path);

  /// All that were read, each once.
  ImageFiles files() && { return std::move(files_); }

 private:
  std::filesystem::path folder_;
  ImageFiles files_;
  size_t bytes_ = 0;
};

}  // namespace scree
