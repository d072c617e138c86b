// GDAL's warper: a raster's heights in the cells of another grid.
#pragma once

#include <ogr_spatialref.h>

#include "shared/base/result.h"
#include "tools/import/gdal/map_transform.h"

namespace scree {

struct WarpGrid {
  MapTransform transform;
  int columns = 0;
  int rows = 0;
};

/// Into a grid of the same map. `exact`: each of its cells is one of the source's.
Result<Dataset> warp_to_grid(GDALDataset& source, const WarpGrid& grid, bool exact);

/// Into another map, by whatever places the source: a geotransform, ground control points, rational
/// polynomials, geolocation arrays. GDAL chooses the grid, with north up.
Result<Dataset> warp_to_map(GDALDataset& source, const OGRSpatialReference* map);

/// Where the middle of the source lies on its map, by any of those.
Result<std::array<double, 2>> middle_by_any(GDALDataset& source);

}  // namespace scree
