// Rasters that GDAL reads, and pictures that it writes. One thread.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/import/raster.h"

namespace scree {

/// The first band of the file. The error names the file, and says what GDAL says.
Result<std::unique_ptr<Raster>> open_raster(const std::string& path);

/// Grey values, row by row.
Result<void> write_grey_png(const std::string& path, int columns, int rows, std::span<const uint8_t> pixels);

}  // namespace scree
