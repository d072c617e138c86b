// GDAL as a whole, for what reads and writes by it.
#pragma once

#include <string>

namespace scree {

/// Makes GDAL ready, once: its formats, a bounded cache, and no words of its own on the standard error.
void prepare_gdal();

/// What GDAL says of its last failure, or if it says nothing, `otherwise`.
std::string gdal_words(const std::string& otherwise);

}  // namespace scree
