#include "tools/import/gdal/gdal_raster.h"

#include <cmath>
#include <cpl_error.h>
#include <gdal_priv.h>
#include <limits>
#include <ogr_spatialref.h>

#include "tools/import/gdal/gdal_library.h"

namespace scree {

namespace {

struct Close {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, Close>;

/// Metres a degree of latitude.
constexpr double degree_m = 111'195.0;

class GdalRaster final : public Raster {
 public:
  explicit GdalRaster(Dataset dataset) : dataset_(std::move(dataset)) {
    band_ = dataset_->GetRasterBand(1);
    int known = 0;
    const double none = band_->GetNoDataValue(&known);
    if (known != 0) none_ = none;
    scale_ = band_->GetScale();
    offset_ = band_->GetOffset();
  }

  Shape shape() const override {
    Shape shape{dataset_->GetRasterXSize(), dataset_->GetRasterYSize(), {}, {}};
    double at[6];
    if (dataset_->GetGeoTransform(at) != CE_None) return shape;
    double x = std::hypot(at[1], at[4]), z = std::hypot(at[2], at[5]);
    const OGRSpatialReference* reference = dataset_->GetSpatialRef();
    if (reference != nullptr && reference->IsGeographic() != 0) {
      const double middle = at[3] + at[5] * static_cast<double>(shape.rows) * 0.5;
      x *= degree_m * std::cos(middle * M_PI / 180.0);
      z *= degree_m;
    } else if (reference != nullptr && reference->IsProjected() != 0) {
      x *= reference->GetLinearUnits();
      z *= reference->GetLinearUnits();
    }
    if (x > 0.0 && z > 0.0 && std::isfinite(x) && std::isfinite(z)) {
      shape.cell_x_m = x;
      shape.cell_z_m = z;
    }
    return shape;
  }

  Result<void> read_row(int row, std::span<double> heights_m) override {
    CPLErrorReset();
    const int columns = dataset_->GetRasterXSize();
    if (band_->RasterIO(GF_Read, 0, row, columns, 1, heights_m.data(), columns, 1, GDT_Float64, 0, 0,
                        nullptr) != CE_None ||
        CPLGetLastErrorType() == CE_Failure)
      return fail("row " + std::to_string(row) + " cannot be read: " + gdal_words("no reason is given"));
    for (double& height : heights_m)
      height = (none_ && height == *none_) || !std::isfinite(height)
                   ? std::numeric_limits<double>::quiet_NaN()
                   : height * scale_ + offset_;
    return {};
  }

 private:
  Dataset dataset_;
  GDALRasterBand* band_ = nullptr;
  std::optional<double> none_;
  double scale_ = 1.0;
  double offset_ = 0.0;
};

}  // namespace

Result<std::unique_ptr<Raster>> open_raster(const std::string& path) {
  prepare_gdal();
  CPLErrorReset();
  Dataset dataset(GDALDataset::FromHandle(GDALOpenEx(
      path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, nullptr, nullptr, nullptr)));
  if (!dataset)
    return fail(path + ": not an elevation model: " + gdal_words("GDAL does not know its format"));
  if (dataset->GetRasterCount() < 1) return fail(path + ": it has no band of heights");
  if (GDALDataTypeIsComplex(dataset->GetRasterBand(1)->GetRasterDataType()) != 0)
    return fail(path + ": its numbers are complex, not heights");
  return std::make_unique<GdalRaster>(std::move(dataset));
}

Result<void> write_grey_png(const std::string& path, int columns, int rows, std::span<const uint8_t> pixels) {
  prepare_gdal();
  CPLErrorReset();
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
