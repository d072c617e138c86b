#include "server/bodies/pending_changes.h"

namespace scree {

namespace {

btVector3 corner_m(VoxelCoord v, float voxel_size_m) {
  return btVector3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)) * voxel_size_m;
}

}  // namespace

void PendingChanges::clear() {
  freed_.clear();
  boxes_.clear();
}

std::vector<Bounds> PendingChanges::waking(float voxel_size_m) const {
  std::vector<Bounds> bounds = freed_;
  for (const VoxelBox& box : boxes_)
    bounds.push_back({corner_m(box.grown(1).lo, voxel_size_m), corner_m(box.grown(1).hi, voxel_size_m)});
  return bounds;
}

void PendingChanges::store(MotionValue& value) const {
  for (const Bounds& bounds : freed_) value.freed.push_back({from_bullet(bounds.lo), from_bullet(bounds.hi)});
  value.changes = boxes_;
}

void PendingChanges::restore(const MotionValue& value) {
  for (const BoundsM& bounds : value.freed)
    freed_.push_back({to_bullet(bounds.lo_m), to_bullet(bounds.hi_m)});
  boxes_ = value.changes;
}

}  // namespace scree
