// Rasters that a child process reads: files of other people may end GDAL, or want more memory and time than
// there is.
#pragma once

#include "tools/import/process/reader_process.h"
#include "tools/import/raster.h"
#include "tools/import/raster_choice.h"

namespace scree {

/// As open_raster(), in a process of its own, which lives as long as the raster.
Result<std::unique_ptr<Raster>> open_raster_apart(const std::string& path, const RasterChoice& choice,
                                                  const ReaderLimits& bounds);

}  // namespace scree
