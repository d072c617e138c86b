// The voxels of a MagicaVoxel scene, all models at their places. Internal to import/vox.
#pragma once

#include <map>

#include "shared/field/coord.h"
#include "tools/import/vox/vox_scene.h"

namespace scree {

/// The colour of each voxel of a brick of 8 a side, in a brick's order; 0: there is none.
using VoxBrick = std::array<uint8_t, 512>;

struct VoxBricks {
  std::map<BrickCoord, VoxBrick> bricks;  ///< none is empty; y points up
  uint64_t voxels = 0;
  uint64_t copies = 0;  ///< of models, that are shown
  uint64_t hidden = 0;  ///< nodes that are not shown, with what is below them
};

/// Where copies overlap, the one that comes later in the scene shows. The error says which limit, or which
/// node, is wrong.
Result<VoxBricks> placed_voxels(const VoxScene& scene);

}  // namespace scree
