// What a search for support finds (support_search.h): masses that break off, and where. Lengths in voxels.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/field/coord.h"

namespace scree {

/// The place where a mass breaks off: voxels to be crushed, two layers on each side of the thinnest section.
struct Neck {
  VoxelBox box;
  int64_t section_voxels = 0;  ///< area of that section, in faces of voxels

  bool operator==(const Neck&) const = default;
};

struct Overload {
  int64_t voxels = 0;  ///< of the mass beyond the necks, within the surroundings
  VoxelCoord start;    ///< one of these voxels
  std::vector<Neck> necks;
  bool by_leverage = false;  ///< bent, though its necks could carry the load
};

/// Voxels that a mass must have to break off: 4 of the smallest pieces. Less than this hangs on.
inline constexpr int64_t overload_voxels_min = 8;

/// Metres a second squared.
inline constexpr float standard_gravity = 9.80665F;

}  // namespace scree
