// The unit in which a band stores heights: by the command line, the band, or the vertical part of the
// coordinate system; metres where none of them says one.
#pragma once

#include <ogr_spatialref.h>
#include <string>

#include "shared/base/result.h"
#include "tools/import/gdal/dataset.h"

namespace scree {

struct HeightUnit {
  double metres = 1.0;  ///< of one unit upwards: negative where the file counts depths
  std::string words;
};

/// `crs` may be null. Refuses units that are no lengths.
Result<HeightUnit> height_unit_of(GDALRasterBand& band, const OGRSpatialReference* crs,
                                  const std::string& chosen);

}  // namespace scree
