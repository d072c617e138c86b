#include "tools/import/gdal/height_dataset.h"

#include <algorithm>
#include <cpl_error.h>
#include <limits>

#include "tools/import/gdal/map_transform.h"

namespace scree {

namespace {

class HeightBand final : public GDALRasterBand {
 public:
  HeightBand(GDALDataset* dataset, HeightValues& values) : values_(values) {
    poDS = dataset;
    nBand = 1;
    eDataType = GDT_Float64;
    values.band().GetBlockSize(&nBlockXSize, &nBlockYSize);
  }
  double GetNoDataValue(int* known) override {
    if (known != nullptr) *known = 1;
    return std::numeric_limits<double>::quiet_NaN();
  }

 protected:
  CPLErr IReadBlock(int block_x, int block_y, void* data) override {
    const int column = block_x * nBlockXSize, row = block_y * nBlockYSize;
    const int columns = std::min(nBlockXSize, values_.band().GetXSize() - column);
    const int rows = std::min(nBlockYSize, values_.band().GetYSize() - row);
    const auto width = static_cast<size_t>(columns);
    heights_m_.resize(width * static_cast<size_t>(rows));
    if (const auto read = values_.read(column, row, columns, rows, heights_m_); !read) {
      CPLError(CE_Failure, CPLE_FileIO, "%s", read.error().message.c_str());
      return CE_Failure;
    }
    auto* const out = static_cast<double*>(data);
    for (size_t z = 0; z < static_cast<size_t>(rows); ++z)
      std::copy_n(heights_m_.begin() + static_cast<std::ptrdiff_t>(z * width), width,
                  out + z * static_cast<size_t>(nBlockXSize));
    return CE_None;
  }

 private:
  HeightValues& values_;
  std::vector<double> heights_m_;
};

}  // namespace

HeightDataset::HeightDataset(GDALDataset& source, HeightValues& values, const OGRSpatialReference* crs)
    : source_(source), crs_(crs) {
  nRasterXSize = source.GetRasterXSize();
  nRasterYSize = source.GetRasterYSize();
  SetBand(1, new HeightBand(this, values));  // the dataset owns it
}

CPLErr HeightDataset::GetGeoTransform(double* transform) {
  const auto found = map_transform_of(source_);
  if (!found) return CE_Failure;
  std::ranges::copy(found->t, transform);
  return CE_None;
}

}  // namespace scree
