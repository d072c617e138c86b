// The files that a mesh's file may name: those of its own folder. Internal to import/assimp.
#pragma once

#include <assimp/IOSystem.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace scree {

/// Opens, for reading, the mesh's file and the .bin, .buffer and .mtl files in its folder and below. No name
/// leads out of the folder, by no link either, and none to a hidden file.
class FolderFiles final : public Assimp::IOSystem {
 public:
  explicit FolderFiles(const std::string& path);

  bool Exists(const char* file) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;
  /// Whether that file is a .png or a .jpg in the folder or below, by the same rule.
  bool allows_picture(const std::filesystem::path& file) const;

  /// The first name that was not opened, as the file says it; empty: none.
  const std::string& refused() const { return refused_; }
  /// The first .mtl file that is not there, as the file says it; empty: none.
  const std::string& missing_materials() const { return missing_materials_; }
  /// The .mtl files that were opened.
  const std::vector<std::string>& materials() const { return materials_; }

 private:
  bool allows(const char* file) const;
  bool lies_within(const std::filesystem::path& path) const;

  std::filesystem::path own_;  ///< absolute, as the folder
  std::filesystem::path folder_;
  std::string refused_;
  std::string missing_materials_;
  std::vector<std::string> materials_;
};

}  // namespace scree
