#include "shared/recombine/stamp_method.h"

#include "shared/base/check.h"
#include "shared/base/overloaded.h"

namespace scree {

VoxelBox stamp_box(StampMethod method, const Volume& volume, const QuantisedPose& pose, float voxel_size_m) {
  return std::visit(Overloaded{[&](const WholeStamp& whole) { return whole.box(volume, pose, voxel_size_m); },
                               [&](const Laying&) { return stamp_box(volume, pose, voxel_size_m); }},
                    traits_of(method).kernel);
}

void stamp(StampMethod method, Window& window, const Volume& volume, const QuantisedPose& pose,
           float voxel_size_m, int shift) {
  std::visit(
      Overloaded{[&](const WholeStamp& whole) { whole.stamp(window, volume, pose, voxel_size_m, shift); },
                 [&](const Laying& laying) { stamp(laying, window, volume, pose, voxel_size_m, shift); }},
      traits_of(method).kernel);
}

StampPlan plan_stamp(StampMethod method, const Window& window, const Volume& volume,
                     const QuantisedPose& pose, float voxel_size_m, MassUnits budget,
                     const MergeFills& fills) {
  return std::visit(Overloaded{[&](const WholeStamp& whole) {
                                 return whole.plan(window, volume, pose, voxel_size_m, budget, fills);
                               },
                               [&](const Laying& laying) {
                                 CHECK(fills.are_solid());
                                 return plan_stamp(laying, window, volume, pose, voxel_size_m, budget);
                               }},
                    traits_of(method).kernel);
}

}  // namespace scree
