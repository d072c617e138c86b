// GDAL as a whole, for what reads and writes by it.
#pragma once

#include <string>
#include <vector>

namespace scree {

/// Makes GDAL ready, once: the formats that it may read (gdal_forms.h), a bounded cache, and no words of its
/// own on the standard error.
void prepare_gdal();

/// What GDAL says of its last failure, or if it says nothing, `otherwise`. Fit to be shown.
std::string gdal_words(const std::string& otherwise);

/// Text of a file for people: without control characters, and not longer than a line.
std::string shown(const char* text);

/// Collects the warnings that GDAL gives in this thread while it lives: the first few, none twice.
class GdalWarnings {
 public:
  explicit GdalWarnings(std::vector<std::string>& warnings);
  ~GdalWarnings();
  GdalWarnings(const GdalWarnings&) = delete;
  GdalWarnings& operator=(const GdalWarnings&) = delete;
};

}  // namespace scree
