#include "client/render/gl/material_images.h"

#include "client/render/scene/limits.h"

namespace scree {
namespace {

constexpr int side = limits::material_image_side;

std::map<Digest, int> layers_for(const Palette& palette) {
  std::map<Digest, int> layers;
  for (const MaterialRow& row : palette.rows)
    for (const std::optional<Digest>& image : {row.look.albedo, row.look.normal})
      if (image && layers.size() < limits::material_images_max)
        layers.try_emplace(*image, static_cast<int>(layers.size()));
  return layers;
}

}  // namespace

/// Another palette's images are uploaded anew: palettes seldom change, and images hardly ever.
void MaterialImages::make_room(const Palette& palette) {
  std::map<Digest, int> layers = layers_for(palette);
  if (layers == layers_) return;
  layers_ = std::move(layers);
  filled_.clear();
  texture_.reset();
  if (layers_.empty()) return;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.emplace().name());
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_REPEAT);
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA8, side, side, static_cast<GLsizei>(layers_.size()), 0, GL_RGBA,
               GL_UNSIGNED_BYTE, nullptr);
}

void MaterialImages::set(const Palette& palette, const MaterialTexelSet& come) {
  make_room(palette);
  bool is_new = false;
  for (const auto& [image, layer] : layers_) {
    const auto found = come.find(image);
    if (found == come.end() || !filled_.insert(image).second) continue;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture_->name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, side, side, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                    found->second->data());
    is_new = true;
  }
  if (is_new) glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
}

int MaterialImages::layer_of(const std::optional<Digest>& image) const {
  return image && filled_.contains(*image) ? layers_.at(*image) : -1;
}

/// With mipmaps.
size_t MaterialImages::bytes() const {
  return layers_.size() * size_t{side} * side * 4 * 4 / 3;
}

}  // namespace scree
