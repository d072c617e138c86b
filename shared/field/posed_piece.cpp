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

/// Trilinear code at p; air outside the window.
float sample_code(const Window& window, VoxelCoord size, glm::vec3 p) {
  const int x = floor_to_int(p.x), y = floor_to_int(p.y), z = floor_to_int(p.z);
  const auto i = static_cast<unsigned>(x - window.box.lo.x), j = static_cast<unsigned>(y - window.box.lo.y),
             k = static_cast<unsigned>(z - window.box.lo.z);
  // One comparison for both ends: what lies below wraps around.
  if (i >= static_cast<unsigned>(size.x - 1) || j >= static_cast<unsigned>(size.y - 1) ||
      k >= static_cast<unsigned>(size.z - 1))
    return code_air;
  const size_t step_y = static_cast<size_t>(size.z);
  const size_t step_x = step_y * static_cast<size_t>(size.y);
  const Code* c = window.codes.data() + (i * step_x + j * step_y + k);
  const float u = p.x - static_cast<float>(x), v = p.y - static_cast<float>(y),
              w = p.z - static_cast<float>(z);
  const auto along_z = [w](const Code* at) {
    return static_cast<float>(at[0]) + static_cast<float>(at[1] - at[0]) * w;
  };
  const float a = along_z(c), b = along_z(c + step_y);
  const float d = along_z(c + step_x), e = along_z(c + step_x + step_y);
  const float low = a + (b - a) * v, high = d + (e - d) * v;
  return low + (high - low) * u;
}

Code rounded(float code) {
  return static_cast<Code>(static_cast<int>(code + (code < 0.0F ? -0.5F : 0.5F)));
}

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
  const VoxelCoord size = volume.window.box.size();
  Window out(box);
  Code* to = out.codes.data();
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y) {
      const glm::vec3 row = axes.local({static_cast<float>(x), static_cast<float>(y), axes.world_centre.z});
      for (int z = box.lo.z; z < box.hi.z; ++z)
        *to++ = rounded(sample_code(volume.window, size,
                                    row + axes.to_local[2] * (static_cast<float>(z) - axes.world_centre.z)));
    }
  return out;
}

}  // namespace scree
