// The highest surface of a field as an elevation model: what lies under overhangs is left out.
#pragma once

#include <functional>
#include <span>

#include "tools/export/exported.h"

namespace scree {

/// Cells in x and z. The middle of the first voxel column of the box is the middle of the first cell, when
/// cells are as large as voxels.
struct ElevationGrid {
  int columns = 0;
  int rows = 0;
  double cell_m = 0.0;
  double west_m = 0.0;   ///< x of the western side
  double north_m = 0.0;  ///< z of the northern side: rows go on with larger z
};

/// `cell_m`: by default as large as a voxel. The error says that cells are smaller.
Result<ElevationGrid> elevation_grid(const ChunkBox& box, float voxel_size_m, std::optional<double> cell_m);

struct ElevationSums {
  uint64_t empty_cells = 0;  ///< without rock in the box
  double lowest_m = 0.0;     ///< of the others
  double highest_m = 0.0;
  double volume_m3 = 0.0;  ///< of the heights above y = 0, each for all of its cell
};

/// Calls write_row(heights) for each row, from the north: y of the highest rock of all voxel columns of a
/// cell, metres, NaN where there is none; rock that reaches the box's top ends there. A few rows lie in
/// memory. `progress(part)`: from 0 to 1. Errors are those of `write_row`, or that there is no rock at all.
Result<ElevationSums> each_elevation_row(Field& field, const ChunkBox& box, const ElevationGrid& grid,
                                         const std::function<Result<void>(std::span<const float>)>& write_row,
                                         const std::function<void(double)>& progress);

}  // namespace scree
