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

/// Into a grid of the same map. `exact`: each of its cells is one of the source's; otherwise heights are
/// between those of the cells around.
Result<Dataset> warp_to_grid(GDALDataset& source, const WarpGrid& grid, bool exact);

/// Into another map; GDAL chooses the grid, with north up. `method` places the source, as GDAL names it:
/// GEOTRANSFORM, GCP_POLYNOMIAL, RPC or GEOLOC_ARRAY. `from`: the source's own map; null where the source
/// names it to GDAL. `map` null: the source's own.
Result<Dataset> warp_to_map(GDALDataset& source, const OGRSpatialReference* from,
                            const OGRSpatialReference* map, const char* method);

/// Where the middle of the source lies on its map.
Result<std::array<double, 2>> middle_on_map(GDALDataset& source, const char* method);

}  // namespace scree
