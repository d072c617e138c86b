// Puts a raster as the world needs it: rows from north to south, columns from west to east, with the length
// of its cells on the ground, at its middle.
//
// Rows and columns that only run the other way are read backwards, so heights stay exactly as they are. A
// raster turned by a quarter is turned back, also without a change of its heights. Any other one is resampled
// by GDAL's warper: turned by an angle, sheared on the ground, or placed by ground control points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/import/gdal/dataset.h"
#include "tools/import/raster.h"

namespace scree {

struct NorthUp {
  Dataset warped{};  ///< null: the source's own cells
  bool flips_rows = false;
  bool flips_columns = false;
  Raster::Shape shape{};
  std::optional<Raster::Place> place{};
  std::vector<std::string> words{};  ///< parts of a sentence: map, cells, direction
};

/// `heights`: with the georeference of the file; it outlives the result. The error says what is wrong with
/// the georeference.
Result<NorthUp> place_north_up(GDALDataset& heights);

}  // namespace scree
