#include "shared/recombine/stamp.h"

#include <algorithm>

#include "shared/base/check.h"
#include "shared/field/redistance.h"

namespace scree {

namespace {

/// Voxels that may become rock and their outside neighbours decide where the surface lies.
constexpr int laid_margin = 1;

/// A shift's two numbers. The lowest shifts have a roundness of −stamp_roundness_max − 1, which no plan uses.
int roundness(int shift) {
  return shift >> stamp_dust_bits;
}
int dust_steps(int shift) {
  return shift & ((1 << stamp_dust_bits) - 1);
}

/// Finds the roundness whose gain is nearest to the mass, or near enough for single codes: from none on along
/// the secant, for the gain is nearly linear in it, and by false position once it lies between two.
/// Leaves the patch in that shape; returns the roundness and its gain.
StampPlan search_roundness(MergePatch& patch, MassUnits mass) {
  constexpr int evaluations_max = 8;
  constexpr int first_up = 24, first_down = 8;  // most pieces are light: sampling takes their edges
  struct End {
    int shift;
    MassUnits off;
  };
  End low{-stamp_roundness_max - 1, 0}, high{stamp_roundness_max + 1, 0}, last{0, 0};
  StampPlan best;
  int shift = 0;
  for (int i = 0; i < evaluations_max; ++i) {
    const MassUnits gain = patch.shape(shift), off = gain - mass;
    if (i == 0 || std::abs(off) < std::abs(best.gain - mass)) best = {shift, gain};
    if (std::abs(off) <= patch.single_codes()) break;
    const bool between = low.shift >= -stamp_roundness_max && high.shift <= stamp_roundness_max;
    const End other = between ? (off < 0 ? high : low) : last;
    (off < 0 ? low : high) = {shift, off};
    if (high.shift - low.shift <= 1) break;
    last = {shift, off};
    const MassUnits rise = off - other.off;
    const int step = off < 0 ? first_up : -first_down;
    const MassUnits guess = i == 0 || rise == 0 ? shift + step : shift - off * (shift - other.shift) / rise;
    shift = static_cast<int>(std::clamp<MassUnits>(guess, low.shift + 1, high.shift - 1));
  }
  if (shift != best.shift) patch.shape(best.shift);
  CHECK(std::abs(best.shift) <= stamp_roundness_max);
  return best;
}

}  // namespace

VoxelBox stamp_box(const Volume& volume, const QuantisedPose& pose, float voxel_size_m) {
  return posed_bounds(volume, pose, voxel_size_m).grown(laid_margin + MergePatch::margin);
}

Window lay(const Laying& laying, const Volume& volume, const QuantisedPose& pose, float voxel_size_m) {
  const VoxelBox box = posed_bounds(volume, pose, voxel_size_m).grown(laid_margin);
  Window posed = posed_codes(volume, pose, voxel_size_m, box, laying.reading);
  const VoxelBox near = near_box(posed);
  return near.empty() ? posed : part_of(posed, common(near.grown(laid_margin), box));
}

Window together(std::vector<Window> laid) {
  CHECK(!laid.empty());
  if (laid.size() == 1) return std::move(laid.front());
  VoxelBox box = laid.front().box;
  for (const Window& one : laid) box = hull_of(box, one.box);
  Window all(box);
  for (const Window& one : laid) {
    const VoxelCoord size = one.box.size();
    const Code* from = one.codes.data();
    for (int x = one.box.lo.x; x < one.box.hi.x; ++x)
      for (int y = one.box.lo.y; y < one.box.hi.y; ++y, from += size.z) {
        Code* to = all.codes.data() + all.index(x, y, one.box.lo.z);
        for (int z = 0; z < size.z; ++z) to[z] = std::min(to[z], from[z]);
      }
  }
  return all;
}

VoxelBox merge_box(const Window& laid) {
  return laid.box.grown(MergePatch::margin);
}

void stamp_laid(const Laying& laying, Window& window, const Window& laid, MassUnits piece_mass, int shift,
                const MergeFills& fills) {
  CHECK(std::abs(shift) <= stamp_shift_max);
  MergePatch patch(window, laid, laying.edges, fills);
  const MassUnits mass = piece_mass + MassUnits{dust_steps(shift)} * stamp_dust_step;
  patch.place(mass - patch.shape(roundness(shift)));
  window.codes = patch.codes();
  redistance(window);
}

StampPlan plan_laid(const Laying& laying, Window& window, const Window& laid, MassUnits piece_mass,
                    MassUnits budget, const MergeFills& fills) {
  MergePatch patch(window, laid, laying.edges, fills);
  const int dust = static_cast<int>(
      std::clamp<MassUnits>((budget - piece_mass) / stamp_dust_step, 0, (1 << stamp_dust_bits) - 1));
  const MassUnits mass = piece_mass + MassUnits{dust} * stamp_dust_step;
  StampPlan plan = search_roundness(patch, mass);
  plan.gain += patch.place(mass - plan.gain);
  plan.shift = plan.shift * (1 << stamp_dust_bits) + dust;
  CHECK_DEBUG(roundness(plan.shift) * (1 << stamp_dust_bits) + dust_steps(plan.shift) == plan.shift &&
              dust_steps(plan.shift) == dust);
  window.codes = patch.codes();
  redistance(window);
  return plan;
}

void stamp(const Laying& laying, Window& window, const Volume& volume, const QuantisedPose& pose,
           float voxel_size_m, int shift) {
  const Window laid = lay(laying, volume, pose, voxel_size_m);
  Window part = part_of(window, merge_box(laid));
  stamp_laid(laying, part, laid, volume.mass, shift);
  put(part, window);
}

StampPlan plan_stamp(const Laying& laying, const Window& window, const Volume& volume,
                     const QuantisedPose& pose, float voxel_size_m, MassUnits budget) {
  const Window laid = lay(laying, volume, pose, voxel_size_m);
  Window part = part_of(window, merge_box(laid));
  return plan_laid(laying, part, laid, volume.mass, budget);
}

}  // namespace scree
