#include "client/render/bricks/corner_atlas.h"

#include <algorithm>
#include <type_traits>

#include "client/render/scene/limits.h"

namespace scree {
namespace {

/// Along x and y; every driver has textures of that size.
constexpr int corner_atlas_side = 256;
constexpr int corner_slots_along = corner_atlas_side / corner_brick_side;

size_t texel_at(int x, int y, int z) {
  return (static_cast<size_t>(z) * corner_atlas_side + static_cast<size_t>(y)) * corner_atlas_side +
         static_cast<size_t>(x);
}

/// How OpenGL names a texel.
struct TexelFormat {
  GLint internal;
  GLenum format;
  GLenum type;
};

template <typename Texel>
constexpr TexelFormat format_of() {
  if constexpr (std::is_same_v<Texel, Look>) return {GL_RG8UI, GL_RG_INTEGER, GL_UNSIGNED_BYTE};
  return {GL_RGBA8_SNORM, GL_RGBA, GL_BYTE};
}

}  // namespace

template <typename Texel>
CornerAtlas<Texel>::CornerAtlas() {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &largest);
  depth_max_ = std::min<GLint>(largest, limits::corner_atlas_depth_max);
  glBindTexture(GL_TEXTURE_3D, texture_.name());
  const Texel none{};
  constexpr TexelFormat as = format_of<Texel>();
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage3D(GL_TEXTURE_3D, 0, as.internal, 1, 1, 1, 0, as.format, as.type, &none);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

template <typename Texel>
void CornerAtlas<Texel>::grow() {
  const int first = depth_ / corner_brick_side;
  const int depth = std::min(std::max(2 * depth_, 2 * corner_brick_side), depth_max_);
  const int end = depth / corner_brick_side;
  if (end == first) return;
  depth_ = depth;
  texels_.resize(texel_at(0, 0, depth_));
  // The last is handed out first: lowest slots first.
  for (int z = end; z-- > first;)
    for (int y = corner_slots_along; y-- > 0;)
      for (int x = corner_slots_along; x-- > 0;)
        free_.push_back({static_cast<uint8_t>(x), static_cast<uint8_t>(y), static_cast<uint8_t>(z)});
  capacity_ += static_cast<size_t>(end - first) * corner_slots_along * corner_slots_along;
  constexpr TexelFormat as = format_of<Texel>();
  glBindTexture(GL_TEXTURE_3D, texture_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage3D(GL_TEXTURE_3D, 0, as.internal, corner_atlas_side, corner_atlas_side, depth_, 0, as.format,
               as.type, texels_.data());
}

template <typename Texel>
std::optional<AtlasSlot> CornerAtlas<Texel>::add(const Brick& brick) {
  if (free_.empty()) grow();
  if (free_.empty()) return std::nullopt;
  const AtlasSlot slot = free_.back();
  free_.pop_back();
  replace(slot, brick);
  return slot;
}

template <typename Texel>
void CornerAtlas<Texel>::replace(AtlasSlot slot, const Brick& brick) {
  constexpr int n = corner_brick_side;
  const Texel* from = brick.data();
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y, from += n)
      std::copy_n(from, n, &texels_[texel_at(slot.x * n, slot.y * n + y, slot.z * n + z)]);
  constexpr TexelFormat as = format_of<Texel>();
  glBindTexture(GL_TEXTURE_3D, texture_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage3D(GL_TEXTURE_3D, 0, slot.x * n, slot.y * n, slot.z * n, n, n, n, as.format, as.type,
                  brick.data());
}

template class CornerAtlas<Look>;
template class CornerAtlas<FacePlane>;

}  // namespace scree
