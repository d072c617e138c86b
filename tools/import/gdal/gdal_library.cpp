#include "tools/import/gdal/gdal_library.h"

#include <cpl_error.h>
#include <gdal_priv.h>

namespace scree {

namespace {

/// Blocks of rasters that GDAL keeps; by itself it would keep a twentieth of the machine's memory.
constexpr int64_t cache_bytes_max = int64_t{64} << 20;

}  // namespace

void prepare_gdal() {
  static const bool done = [] {
    GDALAllRegister();
    GDALSetCacheMax64(cache_bytes_max);
    CPLSetErrorHandler(CPLQuietErrorHandler);  // its words are in our messages
    return true;
  }();
  static_cast<void>(done);
}

std::string gdal_words(const std::string& otherwise) {
  const std::string words = CPLGetLastErrorMsg();
  return words.empty() ? otherwise : words;
}

}  // namespace scree
