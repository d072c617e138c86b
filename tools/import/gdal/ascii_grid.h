// Esri's ASCII grids, whose words GDAL reads leniently: what is no number becomes a height of 0, "1O0"
// becomes 1, and values that are missing at the end become 0, too. Not thread-safe; one call at a time.
#pragma once

#include <cstdint>
#include <string>

#include "shared/base/result.h"

namespace scree {

/// Refuses a grid with a word that is no number, or with more or fewer values than columns × rows. `address`:
/// as GDAL opens it, also within an archive. The error names the row and the column.
Result<void> check_ascii_grid(const std::string& address, uint64_t columns, uint64_t rows);

}  // namespace scree
