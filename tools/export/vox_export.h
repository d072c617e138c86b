// A world's rock as a MagicaVoxel file: the voxels that are rock, each of a colour that is its row of the
// palette. Models have at most 256 voxels a side; larger boxes become several, each at its place.
#pragma once

#include <functional>
#include <string>

#include "shared/material/palette.h"
#include "tools/export/exported.h"

namespace scree {

struct VoxExported {
  uint64_t voxels = 0;
  uint64_t models = 0;
  uint64_t materials = 0;  ///< that occur
  uint64_t bytes = 0;      ///< of the file
};

/// Colour number i is row i − 1, and the file names it. All voxels lie in memory. `progress(part)`: from 0 to
/// 1. The error says that there are none, or too many.
Result<VoxExported> export_vox(Field& field, const Palette& palette, const ChunkBox& box,
                               const std::string& path, const std::function<void(double)>& progress);

}  // namespace scree
