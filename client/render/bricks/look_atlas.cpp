#include "client/render/bricks/look_atlas.h"

#include <algorithm>

#include "client/render/scene/limits.h"

namespace scree {
namespace {

/// Along x and y; every driver has textures of that size.
constexpr int look_atlas_side = 256;
constexpr int look_slots_along = look_atlas_side / look_brick_side;

size_t texel_at(int x, int y, int z) {
  return (static_cast<size_t>(z) * look_atlas_side + static_cast<size_t>(y)) * look_atlas_side +
         static_cast<size_t>(x);
}

}  // namespace

LookAtlas::LookAtlas() {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &largest);
  depth_max_ = std::min<GLint>(largest, limits::look_atlas_depth_max);
  glBindTexture(GL_TEXTURE_3D, texture_.name());
  const Look none{};
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RG8UI, 1, 1, 1, 0, GL_RG_INTEGER, GL_UNSIGNED_BYTE, &none);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void LookAtlas::grow() {
  const int first = depth_ / look_brick_side;
  const int depth = std::min(std::max(2 * depth_, 2 * look_brick_side), depth_max_);
  const int end = depth / look_brick_side;
  if (end == first) return;
  depth_ = depth;
  texels_.resize(texel_at(0, 0, depth_));
  // The last is handed out first: lowest slots first.
  for (int z = end; z-- > first;)
    for (int y = look_slots_along; y-- > 0;)
      for (int x = look_slots_along; x-- > 0;)
        free_.push_back({static_cast<uint8_t>(x), static_cast<uint8_t>(y), static_cast<uint8_t>(z)});
  capacity_ += static_cast<size_t>(end - first) * look_slots_along * look_slots_along;
  glBindTexture(GL_TEXTURE_3D, texture_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RG8UI, look_atlas_side, look_atlas_side, depth_, 0, GL_RG_INTEGER,
               GL_UNSIGNED_BYTE, texels_.data());
}

std::optional<AtlasSlot> LookAtlas::add(const LookBrick& brick) {
  if (free_.empty()) grow();
  if (free_.empty()) return std::nullopt;
  const AtlasSlot slot = free_.back();
  free_.pop_back();
  replace(slot, brick);
  return slot;
}

void LookAtlas::replace(AtlasSlot slot, const LookBrick& brick) {
  constexpr int n = look_brick_side;
  const Look* from = brick.data();
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y, from += n)
      std::copy_n(from, n, &texels_[texel_at(slot.x * n, slot.y * n + y, slot.z * n + z)]);
  glBindTexture(GL_TEXTURE_3D, texture_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage3D(GL_TEXTURE_3D, 0, slot.x * n, slot.y * n, slot.z * n, n, n, n, GL_RG_INTEGER,
                  GL_UNSIGNED_BYTE, brick.data());
}

}  // namespace scree
