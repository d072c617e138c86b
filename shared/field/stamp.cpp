#include "shared/field/stamp.h"

#include <algorithm>

#include "shared/field/merge_patch.h"
#include "shared/field/posed_piece.h"
#include "shared/field/redistance.h"

namespace scree {

namespace {

/// Around the voxels that may become rock: the narrow band that redistancing fills, and the outermost layer,
/// which stays.
constexpr int stamp_margin = 4;

MergePatch patch_of(const Window& window, const Volume& volume, const QuantisedPose& pose,
                    float voxel_size_m) {
  // One voxel more than may become rock: the surface is where it and its outside neighbours put it.
  const VoxelBox box = posed_bounds(volume, pose, voxel_size_m).grown(1);
  return MergePatch(window, posed_codes(volume, pose, voxel_size_m, box));
}

/// Finds the largest shift whose gain is known to stay within the budget: false position (Illinois), for the
/// gain is nearly linear in the shift, then bisection where the surface makes it jump.
template <typename Gain>
StampPlan search_shift(MassUnits budget, Gain&& gain_of) {
  constexpr int evaluations_max = 12;
  constexpr MassUnits near_enough = 0;  // half a code's worth of one voxel
  int low = -stamp_shift_max, high = stamp_shift_max;
  StampPlan best{low, gain_of(low)};
  if (best.gain >= budget) return best;
  const StampPlan most{high, gain_of(high)};
  if (most.gain <= budget) return most;
  auto under = static_cast<double>(best.gain - budget), over = static_cast<double>(most.gain - budget);
  int side = 0;
  for (int i = 0; i < evaluations_max && high - low > 1 && budget - best.gain > near_enough; ++i) {
    const double part = under / (under - over);
    const int guess = low + static_cast<int>(part * (high - low));
    const int middle = std::clamp(i % 4 == 3 ? (low + high) / 2 : guess, low + 1, high - 1);
    const MassUnits gain = gain_of(middle);
    if (gain <= budget) {
      best = {middle, gain};
      low = middle;
      under = static_cast<double>(gain - budget);
      if (side == -1) over *= 0.5;
      side = -1;
    } else {
      high = middle;
      over = static_cast<double>(gain - budget);
      if (side == 1) under *= 0.5;
      side = 1;
    }
  }
  return best;
}

}  // namespace

VoxelBox stamp_box(const Volume& volume, const QuantisedPose& pose, float voxel_size_m) {
  return posed_bounds(volume, pose, voxel_size_m).grown(stamp_margin);
}

void stamp(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m, int shift) {
  MergePatch patch = patch_of(window, volume, pose, voxel_size_m);
  patch.gain(shift);
  patch.write(window);
  redistance(window);
}

StampPlan plan_stamp(const Window& window, const Volume& volume, const QuantisedPose& pose,
                     float voxel_size_m, MassUnits budget) {
  MergePatch patch = patch_of(window, volume, pose, voxel_size_m);
  // What redistancing alone changes, over the whole window, comes on top whatever the shift.
  const MassUnits seams = settling_gain(window);
  StampPlan plan = search_shift(budget - seams, [&](int shift) { return patch.gain(shift); });
  plan.gain += seams;
  return plan;
}

}  // namespace scree
