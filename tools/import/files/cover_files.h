// Land cover from a file, put on a ground of heights that was just imported.
#pragma once

#include "tools/import/cover_import.h"
#include "tools/import/heights_import.h"
#include "tools/import/process/reader_process.h"

namespace scree {

struct CoverOptions {
  std::string raster;    ///< a file; empty: no cover
  std::string map;       ///< a file of lines NUMBER = material
  float reach_m = 1.0F;  ///< below the surface
  float voxel_size_m = 0.25F;
};

/// Imports the model, and puts the cover on it. `palette` is not null. Sentences on the cover go to `said`.
Result<HeightsImported> import_covered_heights(Raster& model, const std::string& path,
                                               const HeightsImport& how, const CoverOptions& cover,
                                               const ReaderLimits& bounds, std::vector<std::string>& said,
                                               const std::function<void(double)>& progress);

}  // namespace scree
