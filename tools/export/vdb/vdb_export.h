// A world's rock as OpenVDB: a level set in metres, and where paint or the ground says a voxel's material,
// its row of the palette in a grid of integers, whose metadata have the palette. At the sides of the box rock
// is cut off, by walls that are a part of the narrow band.
#pragma once

#include <functional>
#include <string>

#include "shared/material/palette.h"
#include "tools/export/exported.h"

namespace scree {

struct VdbExported {
  uint64_t active_voxels = 0;
  uint64_t bytes = 0;  ///< of the file
};

/// All grids lie in memory. `progress(part)`: from 0 to 1.
Result<VdbExported> export_vdb(Field& field, const Palette& palette, const ChunkBox& box,
                               const std::string& path, const std::function<void(double)>& progress);

}  // namespace scree
