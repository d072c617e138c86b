#include "content/files/model_folder.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "content/limits.h"
#include "content/model/glb.h"
#include "crypto/sha256.h"
#include "shared/base/regular_file.h"

namespace scree {

namespace {

/// The names of the models, in their order.
Result<std::vector<std::string>> model_names(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<std::string> names;
  fs::directory_iterator entry(folder, error);
  for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
    const fs::path& path = entry->path();
    std::error_code ignored;
    if (path.extension() != ".glb" || entry->is_directory(ignored)) continue;
    names.push_back(path.filename().string());
    if (names.size() > limits::models_max)
      return fail(folder + ": more than " + std::to_string(limits::models_max) +
                  " models (limits.models_max)");
  }
  if (error) return fail(folder + ": " + error.message());
  if (names.empty()) return fail(folder + ": there is no model in it, which is a file that ends in .glb");
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

Result<ModelFolder> read_model_folder(const std::string& path) {
  ModelFolder folder;
  std::map<Digest, std::vector<uint8_t>> contents;
  size_t all_bytes = 0;
  for (const std::string& name : TRY(model_names(path))) {
    const std::string file = (std::filesystem::path(path) / name).string();
    const auto say = [&](const Error& error) { return fail(file + ": " + error.message); };
    if (const auto is_file = check_is_file(file); !is_file) return say(is_file.error());
    const Result<std::string> read = read_bytes_of(file, limits::model_bytes_max);
    if (!read) return say(read.error());
    std::vector<uint8_t> bytes(read->begin(), read->end());
    const Result<ModelMesh> mesh = read_glb(bytes);
    if (!mesh) return say(mesh.error());
    all_bytes += bytes.size();
    if (all_bytes > limits::models_bytes_max)
      return fail(file + ": with it, the models are over the limit of " +
                  std::to_string(limits::models_bytes_max >> 20U) + " MiB in all (limits.models_bytes_max)");
    const Digest digest = sha256(bytes);
    folder.files.push_back({name, digest, bytes.size(), mesh->triangles()});
    contents.emplace(digest, std::move(bytes));
  }
  folder.contents = std::make_shared<const std::map<Digest, std::vector<uint8_t>>>(std::move(contents));
  return folder;
}

}  // namespace scree
