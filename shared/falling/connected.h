// Which solid voxels of a window connect, by their faces. Pure; lengths in voxels.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/field/window.h"

namespace scree {

/// Solid voxels that connect by faces.
struct Connected {
  VoxelBox box;
  VoxelCoord start;
  size_t voxels = 0;
};

struct ConnectedVoxels {
  std::vector<Connected> all;  ///< in the order of their first voxels
  /// Voxels in the window's order: 1 + the index in `all` of the one that holds it; 0: it is not solid.
  std::vector<uint32_t> labels;
};

/// Follows the window's solid voxels (code < 0).
ConnectedVoxels connected_in(const Window& window);

}  // namespace scree
