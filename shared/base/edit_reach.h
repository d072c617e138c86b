// How far an edit may reach, by the size of a world's voxels. Metres.
#pragma once

#include <algorithm>

#include "shared/base/limits.h"

namespace scree {

/// The greatest reach (half the longest extent) of an edit's shape in voxels of this size: 8 m, and 5.4 m in
/// voxels of 0.1 m.
inline float greatest_edit_reach_m(float voxel_size_m) {
  return std::min(limits::edit_reach_max_m, limits::edit_reach_max_voxels * voxel_size_m);
}

}  // namespace scree
