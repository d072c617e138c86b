#include "tools/import/assimp/folder_files.h"

#include <algorithm>
#include <array>
#include <assimp/DefaultIOSystem.h>
#include <assimp/IOStream.hpp>
#include <string_view>

#include "tools/import/file_forms.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> picture_endings = {".png", ".jpg", ".jpeg"};

/// Buffers of glTF, and materials of OBJ.
constexpr std::array<std::string_view, 3> endings_beside = {".bin", ".buffer", ".mtl"};

fs::path whole(const fs::path& path) {
  std::error_code error;
  return fs::absolute(path, error).lexically_normal();
}

}  // namespace

FolderFiles::FolderFiles(const std::string& path) : own_(whole(path)), folder_(own_.parent_path()) {}

bool FolderFiles::allows(const char* file) const {
  const fs::path path = whole(file);
  if (path == own_) return true;
  if (std::ranges::find(endings_beside, ending_of(path.string())) == endings_beside.end()) return false;
  return lies_within(path);
}

bool FolderFiles::allows_picture(const fs::path& file) const {
  const fs::path path = whole(file);
  const std::string ending = ending_of(path.string());
  return std::ranges::find(picture_endings, ending) != picture_endings.end() && lies_within(path);
}

bool FolderFiles::lies_within(const fs::path& path) const {
  const fs::path within = path.lexically_relative(folder_);
  // ".." begins with a point, too.
  if (within.empty() ||
      std::ranges::any_of(within, [](const fs::path& part) { return part.string().starts_with('.'); }))
    return false;
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error), real_folder = fs::weakly_canonical(folder_, error);
  return !error && real.lexically_relative(real_folder) == within;
}

bool FolderFiles::Exists(const char* file) const {
  std::error_code error;
  return allows(file) && fs::is_regular_file(file, error);
}

Assimp::IOStream* FolderFiles::Open(const char* file, const char* mode) {
  std::error_code error;
  if (!allows(file)) {
    if (refused_.empty()) refused_ = file;
    return nullptr;
  }
  const bool reads = std::string_view(mode).find_first_of("wa+") == std::string_view::npos;
  const bool is_there = fs::is_regular_file(file, error);
  if (ending_of(file) == ".mtl") {
    if (is_there)
      materials_.emplace_back(file);
    else if (missing_materials_.empty())
      missing_materials_ = whole(file).lexically_relative(folder_).string();
  }
  return reads && is_there ? Assimp::DefaultIOSystem().Open(file, mode) : nullptr;
}

void FolderFiles::Close(Assimp::IOStream* stream) {
  delete stream;
}

}  // namespace scree
