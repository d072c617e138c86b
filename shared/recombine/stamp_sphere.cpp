#include "shared/recombine/stamp_sphere.h"

#include <algorithm>

#include "shared/base/check.h"
#include "shared/base/roots.h"
#include "shared/field/edit.h"
#include "shared/field/redistance.h"
#include "shared/recombine/merge_patch.h"
#include "shared/recombine/shift_search.h"

namespace scree {

namespace {

/// Radius at the largest shift, in radii of the ball of the piece's volume: room for three times that volume.
constexpr float growth_max = 1.5F;

/// The ball of the piece's volume, in voxels. A volume that never came from a terrain may claim any mass; the
/// voxels of its window bound it.
Shape ball_of(const Volume& volume, const QuantisedPose& pose, float voxel_size_m) {
  const auto most = static_cast<MassUnits>(volume.window.codes.size()) * units_per_voxel;
  const float voxels = static_cast<float>(std::clamp<MassUnits>(volume.mass, 0, most)) / units_per_voxel;
  constexpr float volume_to_cube = 0.238732415F;  // 3 / 4π
  return sphere(dequantise(pose).position_m / voxel_size_m, cube_root(voxels * volume_to_cube));
}

Shape resized(Shape ball, int shift) {
  CHECK(std::abs(shift) <= stamp_shift_max);
  const float share = static_cast<float>(shift) / static_cast<float>(stamp_shift_max);
  ball.radius_m *= 1.0F + (shift < 0 ? share : (growth_max - 1.0F) * share);
  return ball;
}

}  // namespace

VoxelBox stamp_sphere_box(const Volume& volume, const QuantisedPose& pose, float voxel_size_m) {
  // One more layer, which redistancing keeps.
  return band_box(resized(ball_of(volume, pose, voxel_size_m), stamp_shift_max)).grown(1);
}

void stamp_sphere(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m,
                  int shift) {
  if (shift == -stamp_shift_max) return;
  fill(window, codes_of(resized(ball_of(volume, pose, voxel_size_m), shift), window.box));
  redistance(window);
}

StampPlan plan_sphere(const Window& window, const Volume& volume, const QuantisedPose& pose,
                      float voxel_size_m, MassUnits budget, const MergeFills& fills) {
  const Shape ball = ball_of(volume, pose, voxel_size_m);
  const auto gain_of = [&](int shift) -> MassUnits {
    if (shift == -stamp_shift_max) return 0;
    Window filled = window;
    fill(filled, codes_of(resized(ball, shift), window.box));
    return merge_gain(window, filled, fills);
  };
  return search_shift(-stamp_shift_max, stamp_shift_max, budget, gain_of);
}

}  // namespace scree
