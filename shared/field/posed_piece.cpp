#include "shared/field/posed_piece.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

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

/// Bounds of the voxels within half a voxel of the volume; the whole window where there are none.
VoxelBox near_box(const Window& window) {
  constexpr Code near = 21;  // half a voxel
  const VoxelBox& all = window.box;
  VoxelBox found{all.hi, all.lo};
  const int nz = all.hi.z - all.lo.z;
  const Code* row = window.codes.data();
  for (int x = all.lo.x; x < all.hi.x; ++x)
    for (int y = all.lo.y; y < all.hi.y; ++y, row += nz) {
      int first = 0, last = nz - 1;
      while (first < nz && row[first] > near) ++first;
      if (first == nz) continue;
      while (row[last] > near) --last;
      found.lo = {std::min(found.lo.x, x), std::min(found.lo.y, y), std::min(found.lo.z, all.lo.z + first)};
      found.hi = {std::max(found.hi.x, x + 1), std::max(found.hi.y, y + 1),
                  std::max(found.hi.z, all.lo.z + last + 1)};
    }
  return found.empty() ? all : found;
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

VoxelBox posed_bounds(const Volume& volume, const QuantisedPose& pose, float voxel_size_m) {
  const PosedAxes axes(volume, pose, voxel_size_m);
  // Interpolation carries a voxel's code less than one voxel along each axis.
  const VoxelBox box = near_box(volume.window).grown(1);
  const glm::mat3 to_world = glm::transpose(axes.to_local);
  const glm::vec3 lo(static_cast<float>(box.lo.x), static_cast<float>(box.lo.y),
                     static_cast<float>(box.lo.z));
  const glm::vec3 hi(static_cast<float>(box.hi.x - 1), static_cast<float>(box.hi.y - 1),
                     static_cast<float>(box.hi.z - 1));
  const glm::vec3 half = (hi - lo) * 0.5F;
  const glm::vec3 middle = to_world * ((lo + hi) * 0.5F - axes.local_centre) + axes.world_centre;
  const glm::vec3 reach =
      glm::abs(to_world[0]) * half.x + glm::abs(to_world[1]) * half.y + glm::abs(to_world[2]) * half.z;
  const glm::vec3 first = middle - reach, last = middle + reach;
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
