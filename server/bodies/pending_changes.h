// What has changed since the last step and the bodies have not been told: boxes of terrain, and the bounds of
// bodies that were removed, which wakes their neighbours. Private to this folder.
#pragma once

#include <vector>

#include "server/bodies/body.h"

namespace scree {

class PendingChanges {
 public:
  /// Terrain has changed within this box of voxels.
  void add(const VoxelBox& box) { boxes_.push_back(box); }
  /// A body was there.
  void add(const Bounds& freed) { freed_.push_back(freed); }
  bool empty() const { return boxes_.empty() && freed_.empty(); }
  void clear();

  const std::vector<VoxelBox>& boxes() const { return boxes_; }
  /// Bodies whose bounds meet one of these wake.
  std::vector<Bounds> waking(float voxel_size_m) const;

  /// Writes the changes into `value`, and takes them over from there.
  void store(MotionValue& value) const;
  void restore(const MotionValue& value);

 private:
  std::vector<Bounds> freed_;
  std::vector<VoxelBox> boxes_;
};

}  // namespace scree
