#include "tools/export/gdal/geotiff_export.h"

#include <cmath>
#include <cpl_error.h>
#include <gdal_priv.h>
#include <memory>

#include "ground/whole_file.h"
#include "tools/import/gdal/gdal_library.h"

namespace scree {

namespace {

struct Close {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, Close>;

/// Floats compress by their differences (predictor 3); files over 4 GiB need BigTIFF.
Result<Dataset> create(const std::string& path, const ElevationGrid& grid) {
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  if (driver == nullptr) return fail("this GDAL writes no GeoTIFF");
  const char* options[] = {"COMPRESS=DEFLATE", "PREDICTOR=3", "BIGTIFF=IF_SAFER", nullptr};
  Dataset file(driver->Create(path.c_str(), grid.columns, grid.rows, 1, GDT_Float32,
                              const_cast<char**>(options)));  // GDAL's C interface reads them alone
  if (!file) return fail(gdal_words("no reason is given"));
  double place[6] = {grid.west_m, grid.cell_m, 0.0, -grid.north_m, 0.0, -grid.cell_m};
  if (file->SetGeoTransform(place) != CE_None ||
      file->GetRasterBand(1)->SetNoDataValue(static_cast<double>(geotiff_nodata)) != CE_None)
    return fail(gdal_words("no reason is given"));
  return file;
}

Result<ElevationSums> write(Field& field, const ChunkBox& box, const std::string& path,
                            const ElevationGrid& grid, double zero_m,
                            const std::function<void(double)>& progress) {
  CPLErrorReset();
  auto file = TRY(create(path, grid));
  std::vector<float> row(static_cast<size_t>(grid.columns));
  int rows = 0;
  const auto write_row = [&](std::span<const float> heights_m) -> Result<void> {
    std::ranges::transform(heights_m, row.begin(), [&](float height_m) {
      return std::isnan(height_m) ? geotiff_nodata : height_m + static_cast<float>(zero_m);
    });
    if (file->GetRasterBand(1)->RasterIO(GF_Write, 0, rows++, grid.columns, 1, row.data(), grid.columns, 1,
                                         GDT_Float32, 0, 0, nullptr) != CE_None)
      return fail(gdal_words("no reason is given"));
    return {};
  };
  const auto sums = each_elevation_row(field, box, grid, write_row, progress);
  if (!sums) return sums;
  file->FlushCache(true);
  file.reset();
  if (CPLGetLastErrorType() == CE_Failure) return fail(gdal_words("no reason is given"));
  return sums;
}

}  // namespace

Result<GeotiffExported> export_geotiff(Field& field, const ChunkBox& box, const std::string& path,
                                       const GeotiffExport& how,
                                       const std::function<void(double)>& progress) {
  prepare_gdal();
  const auto grid = TRY(elevation_grid(box, field.source().voxel_size_m, how.cell_m));
  GeotiffExported exported{grid, {}, 0};
  const auto bytes = write_whole(path, [&](const std::string& unfinished) -> Result<void> {
    const auto sums = TRY(write(field, box, unfinished, grid, how.zero_m, progress));
    exported.sums = sums;
    return {};
  });
  TRY(bytes);
  exported.bytes = *bytes;
  return exported;
}

}  // namespace scree
