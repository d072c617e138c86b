// Opens a file of rasters: a file with one, one of the rasters that a file has, or a file in an archive.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shared/base/result.h"
#include "tools/import/gdal/dataset.h"

namespace scree {

/// Where GDAL opens the file of an archive that `layer` means; nothing where `path` is no archive, by its
/// name. "file.nc:height" also chooses a raster of the file, which is left in `layer`. Adds sentences to
/// `said`.
Result<std::optional<std::string>> address_in_archive(const std::string& path, std::string& layer,
                                                      std::vector<std::string>& said);

/// `layer` names or numbers the raster of a file with several, or the file of an archive; empty where there
/// is one. Adds sentences to `said`. The error lists what there is to choose from.
Result<Dataset> open_raster_file(const std::string& path, const std::string& layer,
                                 std::vector<std::string>& said);

}  // namespace scree
