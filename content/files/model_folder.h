// A folder of models (content/model/glb.h) that a server gives its clients. Any thread.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "shared/base/digest.h"
#include "shared/base/result.h"

namespace scree {

struct ModelFile {
  std::string name;  ///< of the file, without its folder
  Digest digest{};
  size_t bytes = 0;
  size_t triangles = 0;
};

struct ModelFolder {
  std::vector<ModelFile> files;  ///< by name
  std::shared_ptr<const std::map<Digest, std::vector<uint8_t>>> contents;
};

/// Reads all files of a folder that end in .glb; others, and folders in it, are passed over. Refuses a folder
/// without any, with too many or too much (content/limits.h), and a file that is no model: the error names
/// it.
Result<ModelFolder> read_model_folder(const std::string& path);

}  // namespace scree
