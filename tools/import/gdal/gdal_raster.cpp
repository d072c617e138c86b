#include "tools/import/gdal/gdal_raster.h"

#include <algorithm>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_frmts.h>
#include <ogr_spatialref.h>
#include <string_view>

#include "tools/import/gdal/gdal_library.h"
#include "tools/import/gdal/height_band.h"
#include "tools/import/gdal/height_dataset.h"
#include "tools/import/gdal/north_up.h"
#include "tools/import/gdal/raster_file.h"
#include "tools/import/gdal/undeclared_nodata.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

/// netCDF says the unit of its axes, also where it names no map.
bool has_axes_of_degrees(GDALDataset& dataset) {
  bool east = false, north = false;
  for (char** line = dataset.GetMetadata(); line != nullptr && *line != nullptr; ++line) {
    const std::string_view text(*line);
    const size_t at = text.find("#units=degree");
    if (at == std::string_view::npos) continue;
    east = east || text.ends_with("_east") || text.ends_with("_E") || text.ends_with("E");
    north = north || text.ends_with("_north") || text.ends_with("_N") || text.ends_with("N");
  }
  return east && north;
}

class GdalRaster final : public Raster {
 public:
  GdalRaster(std::string path, RasterChoice choice) : path_(std::move(path)), choice_(std::move(choice)) {}

  Result<void> open() {
    const GdalWarnings listening(warnings_);
    source_ = TRY(open_raster_file(path_, choice_.layer, said_));
    TRY(find_crs());
    const auto chosen = TRY(choose_height_band(*source_, choice_.band));
    auto unit = TRY(height_unit_of(*chosen.band, crs_.get(), choice_.vertical_unit));
    auto values = TRY(HeightValues::of(*chosen.band, choice_, std::move(unit)));
    values_ = std::make_unique<HeightValues>(std::move(values));
    TRY(check_side());
    heights_ = std::make_unique<HeightDataset>(*source_, *values_, crs_.get());
    placed_ = TRY(place_north_up(*heights_));
    std::string line = "heights from " + chosen.words;
    for (const std::string& part : placed_.words) line += "; " + part;
    for (const std::string& part : values_->words()) line += "; " + part;
    said_.insert(said_.begin(), std::move(line));
    return {};
  }

  Shape shape() const override { return placed_.shape; }
  std::optional<Place> place() const override { return placed_.place; }

  Result<void> check_values(const std::function<void(double)>& progress) override {
    if (choice_.no_nodata) return {};
    const GdalWarnings listening(warnings_);
    return check_undeclared_nodata(*values_, said_, progress);
  }

  Result<void> read_row(int row, std::span<double> heights_m) override {
    const GdalWarnings listening(warnings_);
    const int row_there = placed_.flips_rows ? placed_.shape.rows - 1 - row : row;
    const int columns = placed_.shape.columns;
    if (!placed_.warped) {
      TRY(values_->read(0, row_there, columns, 1, heights_m));
    } else {
      CPLErrorReset();
      if (placed_.warped->GetRasterBand(1)->RasterIO(GF_Read, 0, row_there, columns, 1, heights_m.data(),
                                                     columns, 1, GDT_Float64, 0, 0, nullptr) != CE_None ||
          CPLGetLastErrorType() == CE_Failure)
        return fail(gdal_words("row " + std::to_string(row) + " cannot be read"));
    }
    if (placed_.flips_columns) std::ranges::reverse(heights_m);
    return {};
  }

  std::vector<std::string> said() override {
    std::vector<std::string> lines = said_;
    for (const std::string& warning : warnings_) lines.push_back("GDAL warns: " + warning);
    return lines;
  }

 private:
  /// The command line's map overrides the file's.
  Result<void> find_crs() {
    const OGRSpatialReference* own = source_->GetSpatialRef();
    if (own == nullptr || own->IsEmpty()) own = source_->GetGCPSpatialRef();
    if (choice_.crs.empty()) {
      if (own != nullptr && !own->IsEmpty()) {
        crs_ = std::make_unique<OGRSpatialReference>(*own);
      } else if (has_axes_of_degrees(*source_)) {
        crs_ = std::make_unique<OGRSpatialReference>();
        crs_->SetWellKnownGeogCS("WGS84");
        crs_->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        said_.emplace_back("its axes are in degrees, and it names no map: WGS 84 is assumed");
      }
      return {};
    }
    crs_ = std::make_unique<OGRSpatialReference>();
    if (crs_->SetFromUserInput(choice_.crs.c_str()) != OGRERR_NONE)
      return fail("--crs: '" + choice_.crs +
                  "' is no coordinate system: " + gdal_words("GDAL says no reason"));
    crs_->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return {};
  }

  Result<void> check_side() const {
    const int columns = source_->GetRasterXSize(), rows = source_->GetRasterYSize();
    if (columns <= limits::raster_side_max && rows <= limits::raster_side_max) return {};
    return fail(fmt::format("{} × {} cells: at most {} a side can be imported (limits.raster_side_max)",
                            columns, rows, limits::raster_side_max));
  }

  std::string path_;
  RasterChoice choice_;
  std::vector<std::string> said_;
  std::vector<std::string> warnings_;
  Dataset source_;
  std::unique_ptr<OGRSpatialReference> crs_;
  std::unique_ptr<HeightValues> values_;
  std::unique_ptr<HeightDataset> heights_;
  NorthUp placed_;  ///< its warper reads the above
};

}  // namespace

Result<std::unique_ptr<Raster>> open_raster(const std::string& path, const RasterChoice& choice) {
  prepare_gdal();
  auto raster = std::make_unique<GdalRaster>(path, choice);
  if (const auto opened = raster->open(); !opened) return fail(path + ": " + opened.error().message);
  return raster;
}

Result<void> write_grey_png(const std::string& path, int columns, int rows, std::span<const uint8_t> pixels) {
  prepare_gdal();
  CPLErrorReset();
  GDALRegister_MEM();  // a file may name memory to read, so no reader of files has it
  GDALDriver* const memory = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDriver* const png = GetGDALDriverManager()->GetDriverByName("PNG");
  if (memory == nullptr || png == nullptr) return fail(path + ": this GDAL writes no PNG");
  const Dataset picture(memory->Create("", columns, rows, 1, GDT_Byte, nullptr));
  std::vector<uint8_t> copy(pixels.begin(), pixels.end());
  const bool drawn =
      picture && picture->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, columns, rows, copy.data(), columns,
                                                     rows, GDT_Byte, 0, 0, nullptr) == CE_None;
  CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");  // no file beside it
  const Dataset written(drawn ? png->CreateCopy(path.c_str(), picture.get(), 0, nullptr, nullptr, nullptr)
                              : nullptr);
  if (!written) return fail(path + ": " + gdal_words("it cannot be written"));
  return {};
}

}  // namespace scree
