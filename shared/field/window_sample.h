// Trilinear reading of a window. Pure.
#pragma once

#include <glm/vec3.hpp>

#include "shared/field/field.h"
#include "shared/field/window.h"

namespace scree {

/// Whether the eight voxels around p lie in the window.
inline bool covers(const Window& window, glm::vec3 p_voxels) {
  const VoxelBox& b = window.box;
  const int x = floor_to_int(p_voxels.x), y = floor_to_int(p_voxels.y), z = floor_to_int(p_voxels.z);
  return x >= b.lo.x && y >= b.lo.y && z >= b.lo.z && x + 1 < b.hi.x && y + 1 < b.hi.y && z + 1 < b.hi.z;
}

/// Like sample() of a field, from a window that covers p.
inline FieldSample sample_covered(const Window& window, glm::vec3 p_voxels) {
  CHECK_DEBUG(covers(window, p_voxels));
  const int x = floor_to_int(p_voxels.x), y = floor_to_int(p_voxels.y), z = floor_to_int(p_voxels.z);
  const float fx = p_voxels.x - static_cast<float>(x);
  const float fy = p_voxels.y - static_cast<float>(y);
  const float fz = p_voxels.z - static_cast<float>(z);
  const auto nz = static_cast<size_t>(window.box.hi.z - window.box.lo.z);
  const size_t nyz = static_cast<size_t>(window.box.hi.y - window.box.lo.y) * nz;
  const Code* c = window.codes.data() + window.index(x, y, z);
  const float c000 = c[0], c001 = c[1], c010 = c[nz], c011 = c[nz + 1];
  const float c100 = c[nyz], c101 = c[nyz + 1], c110 = c[nyz + nz], c111 = c[nyz + nz + 1];
  const float x00 = c000 + (c100 - c000) * fx, x01 = c001 + (c101 - c001) * fx;
  const float x10 = c010 + (c110 - c010) * fx, x11 = c011 + (c111 - c011) * fx;
  const float y0 = x00 + (x10 - x00) * fy, y1 = x01 + (x11 - x01) * fy;
  const float low_x = (c100 - c000) * (1 - fy) + (c110 - c010) * fy;
  const float high_x = (c101 - c001) * (1 - fy) + (c111 - c011) * fy;
  const glm::vec3 slope(low_x + (high_x - low_x) * fz, (x10 - x00) * (1 - fz) + (x11 - x01) * fz, y1 - y0);
  constexpr float scale = band_voxels / 127.0F;
  return {(y0 + (y1 - y0) * fz) * scale, slope * scale};
}

}  // namespace scree
