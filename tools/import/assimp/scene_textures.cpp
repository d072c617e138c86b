#include "tools/import/assimp/scene_textures.h"

#include <algorithm>
#include <assimp/material.h>
#include <cmath>
#include <filesystem>

#include "shared/base/regular_file.h"
#include "tools/import/import_palette.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

std::optional<aiString> picture_name(const aiMaterial& material) {
  aiString name;
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE})
    if (material.GetTexture(type, 0, &name) == AI_SUCCESS) return name;
  return std::nullopt;
}

/// A picture in the scene itself has the bytes of its file, or pixels.
Result<Picture> embedded(const aiTexture& texture) {
  if (texture.mHeight == 0)
    return read_picture({reinterpret_cast<const uint8_t*>(texture.pcData), texture.mWidth});
  const uint64_t pixels = uint64_t{texture.mWidth} * texture.mHeight;
  if (pixels > limits::picture_pixels_max) return fail("a picture is too large");
  Picture picture{static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), {}};
  for (uint64_t i = 0; i < pixels; ++i)
    picture.pixels.push_back({texture.pcData[i].r, texture.pcData[i].g, texture.pcData[i].b});
  return picture;
}

size_t pixel_at(float part, int count) {
  const float wrapped = std::isfinite(part) ? part - std::floor(part) : 0.0F;
  return static_cast<size_t>(std::clamp(static_cast<int>(wrapped * static_cast<float>(count)), 0, count - 1));
}

}  // namespace

const Picture* SceneTextures::of(unsigned material) {
  const auto [found, is_new] = pictures_.try_emplace(material);
  if (is_new) found->second = read(material);
  last_ = found->second.get();
  return last_;
}

std::unique_ptr<Picture> SceneTextures::read(unsigned material) {
  const auto name = picture_name(*scene_.mMaterials[material]);
  if (!name) return nullptr;
  Result<Picture> picture = fail("it is not there");
  if (const aiTexture* const own = scene_.GetEmbeddedTexture(name->C_Str())) {
    picture = embedded(*own);
  } else {
    const std::filesystem::path file = std::filesystem::path(path_).parent_path() / name->C_Str();
    if (files_.allows_picture(file))
      if (const auto bytes = read_bytes_of(file, limits::picture_bytes_max);
          bytes && bytes->size() <= limits::picture_bytes_max)
        picture = read_picture({reinterpret_cast<const uint8_t*>(bytes->data()), bytes->size()});
  }
  if (picture && !picture->pixels.empty()) return std::make_unique<Picture>(std::move(*picture));
  ++unread_;
  return nullptr;
}

/// v goes up, and a picture's rows go down.
std::optional<std::array<float, 3>> SceneTextures::colour(const aiMesh& mesh, const aiFace& triangle) const {
  if (last_ == nullptr || !mesh.HasTextureCoords(0)) return std::nullopt;
  aiVector3D middle;
  for (unsigned k = 0; k < 3; ++k) middle += mesh.mTextureCoords[0][triangle.mIndices[k]] / 3.0F;
  const size_t column = pixel_at(middle.x, last_->columns), row = pixel_at(1.0F - middle.y, last_->rows);
  const auto& pixel = last_->pixels[row * static_cast<size_t>(last_->columns) + column];
  return std::array{linear_of_srgb(pixel[0]), linear_of_srgb(pixel[1]), linear_of_srgb(pixel[2])};
}

}  // namespace scree
