// A cube of voxels.
#pragma once

#include "shared/field/coord.h"

namespace scree {

inline VoxelBox cube(int lo, int hi) {
  return {{lo, lo, lo}, {hi, hi, hi}};
}

}  // namespace scree
