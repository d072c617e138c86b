// Finds numbers that fill cells without a height although the file does not declare them: an extreme value,
// far from all others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/import/gdal/height_values.h"

namespace scree {

/// Reads the whole band. Refuses it when its extreme value looks like such a number, and names the option
/// that decides it. Adds a sentence to `said` when the value may be one, or may be a height.
Result<void> check_undeclared_nodata(HeightValues& values, std::vector<std::string>& said,
                                     const std::function<void(double)>& progress);

}  // namespace scree
