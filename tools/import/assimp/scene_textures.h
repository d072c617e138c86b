// Colours of a scene's triangles, by the pictures of its materials. Internal to import/assimp.
#pragma once

#include <array>
#include <assimp/scene.h>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "tools/import/assimp/folder_files.h"
#include "tools/import/gdal/picture.h"

namespace scree {

class SceneTextures {
 public:
  /// `path`: the scene's file. Pictures lie in it, or in its folder (FolderFiles).
  SceneTextures(const aiScene& scene, const std::string& path) : scene_(scene), files_(path), path_(path) {}

  /// The picture of a material's base colour; null: it has none, or one that cannot be read.
  const Picture* of(unsigned material);
  /// Its colour in the middle of a triangle, linear; nothing where the mesh has no coordinates for it.
  std::optional<std::array<float, 3>> colour(const aiMesh& mesh, const aiFace& triangle) const;
  /// Pictures that could not be read.
  size_t unread() const { return unread_; }

 private:
  std::unique_ptr<Picture> read(unsigned material);

  const aiScene& scene_;
  const FolderFiles files_;
  const std::string path_;
  std::map<unsigned, std::unique_ptr<Picture>> pictures_;
  const Picture* last_ = nullptr;
  size_t unread_ = 0;
};

}  // namespace scree
