// One 3D texture of many bricks (atlas_brick.h). Slots are reused; a brick is uploaded by itself. Needs the
// GL context current.
//
// Sides are powers of two: texture coordinates are exact then, and a brick looks the same in any slot.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "client/render/bricks/corner_atlas.h"
#include "client/render/gl/gl.h"
#include "client/render/levels/atlas_brick.h"

namespace scree {

class BrickAtlas {
 public:
  /// Makes room for at least that many bricks, or for as many as the driver's largest texture holds.
  explicit BrickAtlas(size_t bricks);

  /// Nothing when the atlas is full.
  std::optional<AtlasSlot> add(const AtlasBrick& brick);
  void replace(AtlasSlot slot, const AtlasBrick& brick);
  void remove(AtlasSlot slot) { free_.push_back(slot); }

  /// The looks of bricks whose voxels look unlike each other.
  CornerAtlas<Look>& looks() { return looks_; }
  const CornerAtlas<Look>& looks() const { return looks_; }
  /// The planes of bricks in which faces meet.
  CornerAtlas<FacePlane>& planes() { return planes_; }
  const CornerAtlas<FacePlane>& planes() const { return planes_; }

  unsigned texture() const { return texture_.name(); }
  /// Texels along x, y and z.
  const std::array<int, 3>& size() const { return size_; }
  size_t bytes() const;
  size_t bricks() const { return capacity_ - free_.size(); }
  size_t capacity() const { return capacity_; }
  /// Since the start.
  uint64_t uploads() const { return uploads_; }

 private:
  gl::Texture texture_;
  CornerAtlas<Look> looks_;
  CornerAtlas<FacePlane> planes_;
  std::array<int, 3> size_;
  size_t capacity_ = 0;
  std::vector<AtlasSlot> free_;
  uint64_t uploads_ = 0;
};

}  // namespace scree
