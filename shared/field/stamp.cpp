#include "shared/field/stamp.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "shared/base/check.h"
#include "shared/field/redistance.h"

namespace scree {

namespace {

/// Voxels around the posed volume that stamping reads: redistancing reaches the band's depth, and its
/// outermost layer stays.
constexpr int stamp_margin = 4;

struct PosedAxes {
  glm::mat3 to_local;      ///< world directions to the volume's axes
  glm::vec3 world_centre;  ///< voxels
  glm::vec3 local_centre;

  PosedAxes(const Volume& volume, const QuantisedPose& quantised, float voxel_size_m) {
    const Pose pose = dequantise(quantised);
    to_local = glm::transpose(glm::mat3_cast(pose.rotation));
    world_centre = pose.position_m / voxel_size_m;
    local_centre = volume.centre_voxels;
  }
  glm::vec3 local(glm::vec3 world) const { return to_local * (world - world_centre) + local_centre; }
};

/// The part of a volume's window that a stamp can make solid: within the largest shift of the surface, and
/// the voxels that are interpolated with those.
VoxelBox reach_box(const Window& window) {
  constexpr Code within_shift = 43;  // one voxel, stamp_shift_max
  const VoxelBox& all = window.box;
  VoxelBox reach{all.hi, all.lo};
  size_t i = 0;
  for (int x = all.lo.x; x < all.hi.x; ++x)
    for (int y = all.lo.y; y < all.hi.y; ++y)
      for (int z = all.lo.z; z < all.hi.z; ++z, ++i) {
        if (window.codes[i] > within_shift) continue;
        reach.lo = {std::min(reach.lo.x, x), std::min(reach.lo.y, y), std::min(reach.lo.z, z)};
        reach.hi = {std::max(reach.hi.x, x + 1), std::max(reach.hi.y, y + 1), std::max(reach.hi.z, z + 1)};
      }
  return reach.empty() ? all : reach.grown(1);
}

/// Bounds of the posed volume, whole voxels.
VoxelBox posed_box(const Volume& volume, const PosedAxes& axes) {
  const VoxelBox box = reach_box(volume.window);
  const glm::mat3 to_world = glm::transpose(axes.to_local);
  glm::vec3 lo(0.0F), hi(0.0F);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 local(static_cast<float>((corner & 4) != 0 ? box.hi.x - 1 : box.lo.x),
                          static_cast<float>((corner & 2) != 0 ? box.hi.y - 1 : box.lo.y),
                          static_cast<float>((corner & 1) != 0 ? box.hi.z - 1 : box.lo.z));
    const glm::vec3 world = to_world * (local - axes.local_centre) + axes.world_centre;
    lo = corner == 0 ? world : glm::min(lo, world);
    hi = corner == 0 ? world : glm::max(hi, world);
  }
  return {{floor_to_int(lo.x), floor_to_int(lo.y), floor_to_int(lo.z)},
          {floor_to_int(hi.x) + 2, floor_to_int(hi.y) + 2, floor_to_int(hi.z) + 2}};
}

/// Trilinear distance (voxels) in a piece's window; air outside.
float sample_window(const Window& window, glm::vec3 p) {
  const VoxelBox& box = window.box;
  const int x = floor_to_int(p.x), y = floor_to_int(p.y), z = floor_to_int(p.z);
  if (x < box.lo.x || y < box.lo.y || z < box.lo.z || x + 1 >= box.hi.x || y + 1 >= box.hi.y ||
      z + 1 >= box.hi.z)
    return band_voxels;
  const VoxelCoord size = box.size();
  const size_t step_y = static_cast<size_t>(size.z);
  const size_t step_x = step_y * static_cast<size_t>(size.y);
  const Code* c = window.codes.data() + window.index(x, y, z);
  const float u = p.x - static_cast<float>(x), v = p.y - static_cast<float>(y),
              w = p.z - static_cast<float>(z);
  const auto along_z = [w](const Code* at) {
    return static_cast<float>(at[0]) + static_cast<float>(at[1] - at[0]) * w;
  };
  const float a = along_z(c), b = along_z(c + step_y);
  const float d = along_z(c + step_x), e = along_z(c + step_x + step_y);
  const float low = a + (b - a) * v, high = d + (e - d) * v;
  return (low + (high - low) * u) * (band_voxels / 127.0F);
}

/// The piece's own distances on the terrain's grid, before any shift.
struct PosedDistances {
  VoxelBox box;
  std::vector<float> voxels;

  PosedDistances(const Volume& volume, const QuantisedPose& pose, float voxel_size_m) {
    const PosedAxes axes(volume, pose, voxel_size_m);
    box = posed_box(volume, axes);
    voxels.reserve(Window::count(box));
    for (int x = box.lo.x; x < box.hi.x; ++x)
      for (int y = box.lo.y; y < box.hi.y; ++y)
        for (int z = box.lo.z; z < box.hi.z; ++z)
          voxels.push_back(sample_window(
              volume.window,
              axes.local({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)})));
  }
};

/// What stamping works on: the terrain around the piece, and flags of the voxels that the piece changed.
struct Patch {
  Window codes;
  std::vector<uint8_t> touched;
};

VoxelBox patch_box(const PosedDistances& piece) {
  return piece.box.grown(2);
}

Window part_of(const Window& window, const VoxelBox& box) {
  Window part(box);
  const auto count = static_cast<size_t>(box.hi.z - box.lo.z);
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      std::copy_n(window.codes.data() + window.index(x, y, box.lo.z), count,
                  part.codes.data() + part.index(x, y, box.lo.z));
  return part;
}

/// patch := patch ∪ piece, its iso-level shifted.
void unite(Patch& patch, const PosedDistances& piece, int shift) {
  const float grow = static_cast<float>(shift) / stamp_shift_steps_per_voxel;
  std::ranges::fill(patch.touched, uint8_t{0});
  size_t i = 0;
  const auto nz = static_cast<size_t>(piece.box.hi.z - piece.box.lo.z);
  for (int x = piece.box.lo.x; x < piece.box.hi.x; ++x)
    for (int y = piece.box.lo.y; y < piece.box.hi.y; ++y) {
      size_t at = patch.codes.index(x, y, piece.box.lo.z);
      for (size_t z = 0; z < nz; ++z, ++i, ++at) {
        if (piece.voxels[i] >= band_voxels) continue;
        const Code code = encode(piece.voxels[i] - grow);
        if (code >= patch.codes.codes[at]) continue;
        patch.codes.codes[at] = code;
        patch.touched[at] = 1;
      }
    }
}

/// Calls f(index of the row's first inner voxel, how many) for every row along z of the box but its outermost
/// layer.
template <typename F>
void for_each_inner_row(const VoxelBox& box, F&& f) {
  const VoxelCoord size = box.size();
  for (int x = 1; x + 1 < size.x; ++x)
    for (int y = 1; y + 1 < size.y; ++y)
      f((static_cast<size_t>(x) * static_cast<size_t>(size.y) + static_cast<size_t>(y)) *
                static_cast<size_t>(size.z) +
            1,
        static_cast<ptrdiff_t>(size.z) - 2);
}

/// Distance in the array to the next voxel along x, y, z.
struct Steps {
  ptrdiff_t axis[3];
  explicit Steps(const VoxelBox& box)
      : axis{static_cast<ptrdiff_t>(box.size().y) * box.size().z, static_cast<ptrdiff_t>(box.size().z), 1} {}
};

/// Whether the outside voxel lies in a gap narrower than a voxel along some axis, next to what the piece
/// changed.
bool in_thin_gap(const Code* codes, const uint8_t* touched, const Steps& steps) {
  const int here = *codes;
  for (const ptrdiff_t step : steps.axis) {
    const int low = codes[-step], high = codes[step];
    if (low >= 0 || high >= 0) continue;
    if ((touched[0] | touched[-step] | touched[step]) == 0) continue;
    // Width of the gap: here / (here − low) + here / (here − high) < 1, without the divisions.
    if (here * (here - high) + here * (here - low) < (here - low) * (here - high)) return true;
  }
  return false;
}

/// Gaps of less than a voxel between the piece and what it lies against become rock: just inside.
void close_gaps(Patch& patch, std::vector<size_t>& gaps) {
  constexpr Code too_far = 43;  // a voxel from either side by its own account
  const Steps steps(patch.codes.box);
  const Code* codes = patch.codes.codes.data();
  gaps.clear();
  for_each_inner_row(patch.codes.box, [&](size_t first, ptrdiff_t count) {
    for (size_t i = first; i < first + static_cast<size_t>(count); ++i)
      if (codes[i] >= 0 && codes[i] < too_far && in_thin_gap(codes + i, patch.touched.data() + i, steps))
        gaps.push_back(i);
  });
  for (const size_t i : gaps) patch.codes.codes[i] = -1;
}

/// Σ occupancy as it will be once redistanced: voxels that touch no zero crossing will be full, or empty.
/// Without a branch, so that the rows vectorise.
MassUnits settled_mass(const Window& window) {
  const Steps steps(window.box);
  MassUnits sum = 0;
  for_each_inner_row(window.box, [&](size_t first, ptrdiff_t count) {
    const Code* c = window.codes.data() + first;
    int row = 0;
    for (ptrdiff_t z = 0; z < count; ++z) {
      const int own = c[z];
      int signs = 0;  // negative when some neighbour is on the other side
      for (const ptrdiff_t step : steps.axis) signs |= (own ^ c[z - step]) | (own ^ c[z + step]);
      const int crossing = signs >> 31;  // all ones, or none
      const int settled = (own >> 31) & units_per_voxel;
      row += (crossing & occupancy(own)) | (~crossing & settled);
    }
    sum += row;
  });
  return sum;
}

MassUnits plain_mass(const Window& window) {
  MassUnits sum = 0;
  for_each_inner_row(window.box, [&](size_t first, ptrdiff_t count) {
    int row = 0;
    for (ptrdiff_t z = 0; z < count; ++z) row += occupancy(window.codes[first + static_cast<size_t>(z)]);
    sum += row;
  });
  return sum;
}

/// Finds the largest shift whose gain is known to stay within the budget: false position (Illinois), for the
/// gain is nearly linear in the shift, then bisection where gaps that close make it jump.
template <typename Gain>
StampPlan search_shift(MassUnits budget, Gain&& gain_of) {
  constexpr int evaluations_max = 14;
  int low = -stamp_shift_max, high = stamp_shift_max;
  StampPlan best{high, gain_of(high)};
  if (best.gain <= budget) return best;
  best = {low, gain_of(low)};
  if (best.gain >= budget) return best;
  double under = static_cast<double>(best.gain - budget), over = static_cast<double>(gain_of(high) - budget);
  int side = 0;
  for (int i = 0; i < evaluations_max && high - low > 1; ++i) {
    const double part = under / (under - over);
    const int guess = low + static_cast<int>(part * (high - low));
    const int middle = std::clamp(i % 4 == 3 ? (low + high) / 2 : guess, low + 1, high - 1);
    const MassUnits gain = gain_of(middle);
    if (gain <= budget) {
      best = {middle, gain};
      low = middle;
      under = static_cast<double>(gain - budget);
      if (gain == budget) break;
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
  return posed_box(volume, PosedAxes(volume, pose, voxel_size_m)).grown(stamp_margin);
}

void stamp(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m, int shift) {
  const PosedDistances piece(volume, pose, voxel_size_m);
  Patch patch{window, std::vector<uint8_t>(window.codes.size())};
  std::vector<size_t> gaps;
  unite(patch, piece, shift);
  close_gaps(patch, gaps);
  window = std::move(patch.codes);
  redistance(window);
}

StampPlan plan_stamp(const Window& window, const Volume& volume, const QuantisedPose& pose,
                     float voxel_size_m, MassUnits budget) {
  const PosedDistances piece(volume, pose, voxel_size_m);
  const VoxelBox box = patch_box(piece);
  const Window before = part_of(window, box);
  const MassUnits settled_before = settled_mass(before);
  Patch patch{before, std::vector<uint8_t>(before.codes.size())};
  std::vector<size_t> gaps;
  const auto gain_of = [&](int shift) {
    patch.codes = before;
    unite(patch, piece, shift);
    close_gaps(patch, gaps);
    return settled_mass(patch.codes) - settled_before;
  };
  // What redistancing alone changes, over the whole window, comes on top whatever the shift.
  const MassUnits seams = settled_mass(window) - plain_mass(window);
  StampPlan plan = search_shift(budget - seams, gain_of);
  plan.gain += seams;
  return plan;
}

}  // namespace scree
