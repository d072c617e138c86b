// One 3D texture of the looks of bricks whose voxels look unlike each other (level_bricks.h). It grows with
// them: untouched terrain has none. Needs the GL context current.
#pragma once

#include <optional>
#include <vector>

#include "client/render/gl/gl.h"
#include "client/render/levels/level_bricks.h"

namespace scree {

class LookAtlas {
 public:
  LookAtlas();

  /// Nothing when the atlas is full.
  std::optional<AtlasSlot> add(const LookBrick& brick);
  void replace(AtlasSlot slot, const LookBrick& brick);
  void remove(AtlasSlot slot) { free_.push_back(slot); }

  unsigned texture() const { return texture_.name(); }
  size_t bricks() const { return capacity_ - free_.size(); }
  size_t bytes() const { return texels_.size() * sizeof(Look); }

 private:
  void grow();

  gl::Texture texture_;
  int depth_ = 0;  ///< texels along z
  int depth_max_ = 0;
  size_t capacity_ = 0;
  std::vector<AtlasSlot> free_;
  std::vector<Look> texels_;  ///< as on the GPU, from where no larger texture can take them
};

}  // namespace scree
