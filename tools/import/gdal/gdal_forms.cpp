#include "tools/import/gdal/gdal_forms.h"

#include <algorithm>
#include <array>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <memory>
#include <ogr_srs_api.h>
#include <string_view>
#include <vector>

namespace scree {

namespace {

constexpr std::array<std::string_view, 44> drivers{
    "GTiff",    "COG",       "AAIGrid",     "GRASSASCIIGrid",
    "ISG",      "EHdr",      "ENVI",        "SRTMHGT",
    "USGSDEM",  "DTED",      "HFA",         "XYZ",
    "PNG",      "JPEG",      "JP2OpenJPEG", "BMP",
    "PNM",      "netCDF",    "HDF5",        "BAG",
    "HDF4",     "HDF5Image", "GRIB",        "HDF4Image",
    "GSAG",     "GSBG",      "GS7BG",       "GTX",
    "BT",       "SAGA",      "NWT_GRD",     "GXF",
    "Terragen", "ZMap",      "Leveller",    "RST",
    "BYN",      "HF2",       "ACE2",        "PCRaster",
    "SIGDEM",   "NGSGEOID",  "FITS",        "NTv2",
};

/// Files within files, and in memory.
constexpr std::array<std::string_view, 5> file_systems{"/vsizip/", "/vsitar/", "/vsigzip/", "/vsisubfile/",
                                                       "/vsimem/"};

/// First words of files that name other ones, and what the files are.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> describers{{
    {"<VRTDataset", "a VRT"},
    {"<GDAL_WMS", "a WMS"},
    {"<WMS", "a WMS"},
    {"<WCS", "a WCS"},
    {"<GDAL_WMTS", "a WMTS"},
    {"<WMTS", "a WMTS"},
    {"<Capabilities", "a WMTS"},
}};

void* open_nothing(void*, const char*, const char*) {
  return nullptr;
}

int stat_nothing(void*, const char*, VSIStatBufL*, int) {
  return -1;
}

void close_file_system(const char* prefix) {
  const std::unique_ptr<VSIFilesystemPluginCallbacksStruct, void (*)(VSIFilesystemPluginCallbacksStruct*)>
      nothing(VSIAllocFilesystemPluginCallbacksStruct(), VSIFreeFilesystemPluginCallbacksStruct);
  nothing->open = open_nothing;
  nothing->stat = stat_nothing;
  VSIInstallPluginHandler(prefix, nothing.get());
}

struct CloseFile {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

}  // namespace

void leave_allowed_forms() {
  GDALDriverManager& all = *GetGDALDriverManager();
  for (int i = all.GetDriverCount() - 1; i >= 0; --i) {
    GDALDriver* const driver = all.GetDriver(i);
    if (std::ranges::find(drivers, std::string_view(driver->GetDescription())) != drivers.end()) continue;
    all.DeregisterDriver(driver);
    delete driver;
  }
  const CPLStringList prefixes(VSIGetFileSystemsPrefixes());
  for (int i = 0; i < prefixes.size(); ++i)
    if (std::ranges::find(file_systems, std::string_view(prefixes[i])) == file_systems.end())
      close_file_system(prefixes[i]);
  OSRSetPROJEnableNetwork(0);
}

Result<void> check_holds_numbers(const std::string& address) {
  const std::unique_ptr<VSILFILE, CloseFile> file(VSIFOpenL(address.c_str(), "rb"));
  if (file == nullptr) return {};  // its opening says so
  constexpr size_t examined = 4096;
  std::string start(examined, '\0');
  start.resize(VSIFReadL(start.data(), 1, start.size(), file.get()));
  const size_t first = start.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first == std::string::npos || start[first] != '<') return {};
  for (const auto& [word, kind] : describers)
    if (start.find(word) != std::string::npos)
      return fail(
          fmt::format("{}, which holds no heights but names where they lie, and import follows no "
                      "such name: make a GeoTIFF of it (gdal_translate FILE out.tif), import that",
                      kind));
  return fail("XML, which holds no heights: make a GeoTIFF of it (gdal_translate FILE out.tif), import that");
}

}  // namespace scree
