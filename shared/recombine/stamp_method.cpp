#include "shared/recombine/stamp_method.h"

#include "shared/recombine/stamp_slices.h"
#include "shared/recombine/stamp_sphere.h"

namespace scree {

VoxelBox stamp_box(StampMethod method, const Volume& volume, const QuantisedPose& pose, float voxel_size_m) {
  return method == StampMethod::sphere ? stamp_sphere_box(volume, pose, voxel_size_m)
                                       : stamp_box(volume, pose, voxel_size_m);
}

void stamp(StampMethod method, Window& window, const Volume& volume, const QuantisedPose& pose,
           float voxel_size_m, int shift) {
  switch (method) {
    case StampMethod::stamp:
    case StampMethod::facets:
      return stamp(window, volume, pose, voxel_size_m, shift, method);
    case StampMethod::slices:
      return stamp_slices(window, volume, pose, voxel_size_m, shift);
    case StampMethod::sphere:
      return stamp_sphere(window, volume, pose, voxel_size_m, shift);
  }
}

StampPlan plan_stamp(StampMethod method, const Window& window, const Volume& volume,
                     const QuantisedPose& pose, float voxel_size_m, MassUnits budget) {
  switch (method) {
    case StampMethod::slices:
      return plan_slices(window, volume, pose, voxel_size_m, budget);
    case StampMethod::sphere:
      return plan_sphere(window, volume, pose, voxel_size_m, budget);
    case StampMethod::stamp:
    case StampMethod::facets:
      break;
  }
  return plan_stamp(window, volume, pose, voxel_size_m, budget, method);
}

}  // namespace scree
