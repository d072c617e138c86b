// A field's highest surface as a GeoTIFF, by GDAL.
#pragma once

#include <string>

#include "tools/export/elevation.h"

namespace scree {

struct GeotiffExport {
  std::optional<double> cell_m{};  ///< default: as large as a voxel
  double zero_m = 0.0;             ///< height in the file of what is y = 0 in the world
};

struct GeotiffExported {
  ElevationGrid grid;
  ElevationSums sums;  ///< of the world's heights
  uint64_t bytes = 0;  ///< of the file
};

/// The value of cells without rock.
inline constexpr float geotiff_nodata = -9999.0F;

/// Metres east and north of the world's origin, floats, without a reference to the Earth: grounds keep none.
/// `progress(part)`: from 0 to 1.
Result<GeotiffExported> export_geotiff(Field& field, const ChunkBox& box, const std::string& path,
                                       const GeotiffExport& how, const std::function<void(double)>& progress);

}  // namespace scree
