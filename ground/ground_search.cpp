#include "ground/ground_search.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "ground/limits.h"
#include "shared/base/xdg_folder.h"

namespace scree {

namespace {

namespace fs = std::filesystem;

/// In order of their names, so that the same one is found every time.
std::vector<fs::path> ground_files_in(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (at->path().extension() == ".ground") files.push_back(at->path());
    if (files.size() >= limits::ground_files_max) break;
  }
  std::ranges::sort(files);
  return files;
}

bool has_name(const fs::path& path, const Digest& name) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::vector<uint8_t> bytes(header_bytes);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) return false;
  const auto header = decode_header(bytes);
  return header && name_of(*header) == name;
}

}  // namespace

std::vector<std::string> ground_folders(const std::string& path) {
  const fs::path own = fs::path(path).parent_path();
  std::vector<std::string> folders{own.empty() ? "." : own.string()};
  if (const std::string all = xdg_folder("XDG_DATA_HOME", ".local/share"); !all.empty())
    folders.push_back((fs::path(all) / "grounds").string());
  return folders;
}

Result<std::shared_ptr<const GroundFile>> find_ground(const Digest& name,
                                                      const std::vector<std::string>& folders) {
  std::string looked;
  for (const std::string& folder : folders) {
    for (const fs::path& path : ground_files_in(folder))
      if (has_name(path, name)) return GroundFile::open(path.string());
    looked += (looked.empty() ? "" : " and ") + folder;
  }
  return fail("its ground " + hex_of(name) + " is in no .ground file of " + looked +
              ": say where it lies (--ground)");
}

}  // namespace scree
