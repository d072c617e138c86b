// Rasters that GDAL reads, and pictures that it writes. One thread.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/import/raster.h"
#include "tools/import/raster_choice.h"

namespace scree {

/// The heights of a file, in this process. The error names the file, and says what GDAL says.
Result<std::unique_ptr<Raster>> open_raster(const std::string& path, const RasterChoice& choice = {});

/// Grey values, row by row.
Result<void> write_grey_png(const std::string& path, int columns, int rows, std::span<const uint8_t> pixels);

}  // namespace scree
