// One 3D texture of values at the corners of the cells of bricks that need them: samples 0 … 8 along each
// axis. These are the looks of bricks whose voxels look unlike each other, and the planes of bricks in which
// faces meet (level_bricks.h). It grows with them: untouched smooth terrain has none. Needs the GL context
// current.
#pragma once

#include <optional>
#include <vector>

#include "client/render/gl/gl.h"
#include "client/render/levels/level_bricks.h"

namespace scree {

/// Texel: Look or FacePlane.
template <typename Texel>
class CornerAtlas {
 public:
  using Brick = std::array<Texel, corner_brick_side * corner_brick_side * corner_brick_side>;

  CornerAtlas();

  /// Nothing when the atlas is full.
  std::optional<AtlasSlot> add(const Brick& brick);
  void replace(AtlasSlot slot, const Brick& brick);
  void remove(AtlasSlot slot) { free_.push_back(slot); }

  unsigned texture() const { return texture_.name(); }
  size_t bricks() const { return capacity_ - free_.size(); }
  size_t bytes() const { return texels_.size() * sizeof(Texel); }

 private:
  void grow();

  gl::Texture texture_;
  int depth_ = 0;  ///< texels along z
  int depth_max_ = 0;
  size_t capacity_ = 0;
  std::vector<AtlasSlot> free_;
  std::vector<Texel> texels_;  ///< as on the GPU, from where no larger texture can take them
};

extern template class CornerAtlas<Look>;
extern template class CornerAtlas<FacePlane>;

}  // namespace scree
