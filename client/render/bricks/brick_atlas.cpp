#include "client/render/bricks/brick_atlas.h"

#include <algorithm>

#include "client/render/scene/limits.h"

namespace scree {
namespace {

size_t slots_along(int texels) {
  return static_cast<size_t>(texels / atlas_brick_side);
}

}  // namespace

BrickAtlas::BrickAtlas(size_t bricks) : size_{128, 128, 32} {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &largest);
  largest = std::min<GLint>(largest, limits::atlas_side_max);
  const auto room = [this] { return slots_along(size_[0]) * slots_along(size_[1]) * slots_along(size_[2]); };
  while (room() < bricks) {
    const auto side = std::ranges::min_element(size_);
    if (*side * 2 > largest) break;
    *side *= 2;
  }
  capacity_ = room();
  // The last is handed out first: lowest slots first.
  for (size_t z = slots_along(size_[2]); z-- > 0;)
    for (size_t y = slots_along(size_[1]); y-- > 0;)
      for (size_t x = slots_along(size_[0]); x-- > 0;)
        free_.push_back({static_cast<uint8_t>(x), static_cast<uint8_t>(y), static_cast<uint8_t>(z)});
  glBindTexture(GL_TEXTURE_3D, texture_.name());
  glTexImage3D(GL_TEXTURE_3D, 0, GL_R8_SNORM, size_[0], size_[1], size_[2], 0, GL_RED, GL_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTexParameteri(GL_TEXTURE_3D, axis, GL_CLAMP_TO_EDGE);
}

std::optional<AtlasSlot> BrickAtlas::add(const AtlasBrick& brick) {
  if (free_.empty()) return std::nullopt;
  const AtlasSlot slot = free_.back();
  free_.pop_back();
  replace(slot, brick);
  return slot;
}

void BrickAtlas::replace(AtlasSlot slot, const AtlasBrick& brick) {
  glBindTexture(GL_TEXTURE_3D, texture_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage3D(GL_TEXTURE_3D, 0, slot.x * atlas_brick_side, slot.y * atlas_brick_side,
                  slot.z * atlas_brick_side, atlas_brick_side, atlas_brick_side, atlas_brick_side, GL_RED,
                  GL_BYTE, brick.data());
  ++uploads_;
}

size_t BrickAtlas::bytes() const {
  return static_cast<size_t>(size_[0]) * static_cast<size_t>(size_[1]) * static_cast<size_t>(size_[2]) +
         looks_.bytes() + planes_.bytes();
}

}  // namespace scree
