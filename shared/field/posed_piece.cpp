#include "shared/field/posed_piece.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

namespace scree {

namespace {

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

constexpr Code near_surface = 21;  ///< half a voxel

/// Calls f(x, y, first z, last z) for the rows with voxels near the surface or inside.
template <typename F>
void for_each_near_row(const Window& window, F&& f) {
  const VoxelBox& all = window.box;
  const int nz = all.hi.z - all.lo.z;
  const Code* row = window.codes.data();
  for (int x = all.lo.x; x < all.hi.x; ++x)
    for (int y = all.lo.y; y < all.hi.y; ++y, row += nz) {
      int first = 0, last = nz - 1;
      while (first < nz && row[first] > near_surface) ++first;
      if (first == nz) continue;
      while (row[last] > near_surface) --last;
      f(x, y, all.lo.z + first, all.lo.z + last);
    }
}

int ceil_to_int(float x) {
  return -floor_to_int(-x);
}

using Lanes = float __attribute__((vector_size(16)));
using IntLanes = int __attribute__((vector_size(16)));

Lanes lanes(glm::vec3 v) {
  return Lanes{v.x, v.y, v.z, 0.0F};
}

/// Reads a window's codes trilinearly, in vectors spelt out: left to itself the compiler took each coordinate
/// for itself, and twice the time.
class Sampler {
 public:
  explicit Sampler(const Window& window)
      : lo_{window.box.lo.x, window.box.lo.y, window.box.lo.z, 0},
        // A cell's far corner must lie in the window, too.
        last_{window.box.hi.x - 2 - window.box.lo.x, window.box.hi.y - 2 - window.box.lo.y,
              window.box.hi.z - 2 - window.box.lo.z, 0},
        step_y_(window.box.size().z),
        step_x_(step_y_ * window.box.size().y),
        codes_(window.codes.begin(), window.codes.end()) {}

  /// The nearest code at p, of which only three lanes count; air outside the window.
  Code at(Lanes p) const {
    IntLanes cell = __builtin_convertvector(p, IntLanes);
    cell += p < __builtin_convertvector(cell, Lanes);  // all ones is −1: the largest integer not above
    const Lanes part = p - __builtin_convertvector(cell, Lanes);
    const IntLanes at = cell - lo_;
    const IntLanes outside = (at < 0) | (at > last_);
    if ((outside[0] | outside[1] | outside[2]) != 0) return code_air;
    const float* c = codes_.data() + (at[0] * step_x_ + at[1] * step_y_ + at[2]);
    const Lanes near{c[0], c[step_y_], c[step_x_], c[step_x_ + step_y_]};
    const Lanes far{c[1], c[step_y_ + 1], c[step_x_ + 1], c[step_x_ + step_y_ + 1]};
    const Lanes along_z = near + (far - near) * part[2];
    const float low = along_z[0] + (along_z[1] - along_z[0]) * part[1];
    const float high = along_z[2] + (along_z[3] - along_z[2]) * part[1];
    const float code = low + (high - low) * part[0];
    return static_cast<Code>(static_cast<int>(code + (code < 0.0F ? -0.5F : 0.5F)));
  }

 private:
  IntLanes lo_;
  IntLanes last_;
  ptrdiff_t step_y_;
  ptrdiff_t step_x_;
  std::vector<float> codes_;
};

}  // namespace

VoxelBox near_box(const Window& window) {
  VoxelBox found{window.box.hi, window.box.lo};
  for_each_near_row(window, [&](int x, int y, int first, int last) {
    found.lo = {std::min(found.lo.x, x), std::min(found.lo.y, y), std::min(found.lo.z, first)};
    found.hi = {std::max(found.hi.x, x + 1), std::max(found.hi.y, y + 1), std::max(found.hi.z, last + 1)};
  });
  return found;
}

VoxelBox posed_bounds(const Volume& volume, const QuantisedPose& pose, float voxel_size_m) {
  const PosedAxes axes(volume, pose, voxel_size_m);
  const glm::mat3 to_world = glm::transpose(axes.to_local);
  glm::vec3 lo(std::numeric_limits<float>::max()), hi(-lo);
  const auto include = [&](int x, int y, int z) {
    const glm::vec3 local(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
    const glm::vec3 world = to_world * (local - axes.local_centre);
    lo = glm::min(lo, world);
    hi = glm::max(hi, world);
  };
  for_each_near_row(volume.window, [&](int x, int y, int first, int last) {
    include(x, y, first);
    include(x, y, last);
  });
  if (lo.x > hi.x) {
    const VoxelBox& box = volume.window.box;
    for (int corner = 0; corner < 8; ++corner)
      include((corner & 4) != 0 ? box.hi.x - 1 : box.lo.x, (corner & 2) != 0 ? box.hi.y - 1 : box.lo.y,
              (corner & 1) != 0 ? box.hi.z - 1 : box.lo.z);
  }
  // Interpolation carries a voxel's code less than one voxel along each of the volume's axes.
  const glm::vec3 reach = glm::abs(to_world[0]) + glm::abs(to_world[1]) + glm::abs(to_world[2]);
  const glm::vec3 first = axes.world_centre + lo - reach, last = axes.world_centre + hi + reach;
  return {{ceil_to_int(first.x), ceil_to_int(first.y), ceil_to_int(first.z)},
          {floor_to_int(last.x) + 1, floor_to_int(last.y) + 1, floor_to_int(last.z) + 1}};
}

Window posed_codes(const Volume& volume, const QuantisedPose& pose, float voxel_size_m, const VoxelBox& box) {
  const PosedAxes axes(volume, pose, voxel_size_m);
  const Sampler sampler(volume.window);
  const Lanes along = lanes(axes.to_local[2]);
  Window out(box);
  Code* to = out.codes.data();
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y) {
      const Lanes row =
          lanes(axes.local({static_cast<float>(x), static_cast<float>(y), axes.world_centre.z}));
      for (int z = box.lo.z; z < box.hi.z; ++z)
        *to++ = sampler.at(row + along * (static_cast<float>(z) - axes.world_centre.z));
    }
  return out;
}

}  // namespace scree
