// A body's own copy of the codes around it: a hash lookup for each code would cost ten times more. Voxels.
// Not thread-safe.
#pragma once

#include "shared/field/window_sample.h"

namespace scree {

class NearbyCodes {
 public:
  /// `field` must outlive this object.
  explicit NearbyCodes(const Field& field) : field_(field) {}

  /// Whether codes() covers the bounds, for sampling anywhere between `lo` and `hi`.
  bool has(glm::vec3 lo, glm::vec3 hi) const { return covers(codes_, lo) && covers(codes_, hi); }
  /// Makes codes() cover the bounds. Reads the field.
  void copy_around(glm::vec3 lo, glm::vec3 hi);
  /// Drops the copy if it overlaps this box.
  void terrain_changed(const VoxelBox& box);

  const Window& codes() const { return codes_; }
  /// Whether every code of the copy is air.
  bool all_air() const { return all_air_; }

 private:
  const Field& field_;
  Window codes_;
  bool all_air_ = false;
};

/// Whether two boxes have a voxel in common.
bool overlap(const VoxelBox& a, const VoxelBox& b);

/// The smallest box with all voxels that sampling between these corners may read.
VoxelBox box_around(glm::vec3 lo, glm::vec3 hi);

}  // namespace scree
