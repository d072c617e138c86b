#include "tools/import/gdal/gdal_library.h"

#include <algorithm>
#include <cpl_error.h>
#include <gdal_priv.h>

#include "shared/base/text.h"
#include "tools/import/gdal/gdal_forms.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

/// Blocks of rasters that GDAL keeps; by itself it would keep a twentieth of the machine's memory.
constexpr int64_t cache_bytes_max = int64_t{64} << 20;

void collect_warning(CPLErr kind, CPLErrorNum, const char* words) {
  auto& warnings = *static_cast<std::vector<std::string>*>(CPLGetErrorHandlerUserData());
  if (kind != CE_Warning || warnings.size() >= limits::raster_warnings_max) return;
  std::string text = shown(words);
  if (std::ranges::find(warnings, text) == warnings.end()) warnings.push_back(std::move(text));
}

}  // namespace

void prepare_gdal() {
  static const bool done = [] {
    GDALAllRegister();
    leave_allowed_forms();
    GDALSetCacheMax64(cache_bytes_max);
    CPLSetErrorHandler(CPLQuietErrorHandler);  // its words are in our messages
    return true;
  }();
  static_cast<void>(done);
}

std::string gdal_words(const std::string& otherwise) {
  const std::string words = shown(CPLGetLastErrorMsg());
  return words.empty() ? otherwise : words;
}

std::string shown(const char* text) {
  return text == nullptr ? std::string() : showable(text, limits::raster_text_bytes_max);
}

GdalWarnings::GdalWarnings(std::vector<std::string>& warnings) {
  CPLPushErrorHandlerEx(collect_warning, &warnings);
}

GdalWarnings::~GdalWarnings() {
  CPLPopErrorHandler();
}

}  // namespace scree
