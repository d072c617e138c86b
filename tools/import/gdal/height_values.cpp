#include "tools/import/gdal/height_values.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "tools/import/gdal/gdal_library.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

constexpr double no_height = std::numeric_limits<double>::quiet_NaN();

bool is_integer(GDALDataType type) {
  return GDALDataTypeIsInteger(type) != 0;
}

/// The lowest and the highest number of the type.
std::pair<double, double> range_of(GDALDataType type, bool signed_bytes) {
  const int bits = GDALGetDataTypeSizeBits(type);
  if (signed_bytes || GDALDataTypeIsSigned(type) != 0)
    return {-std::ldexp(1.0, bits - 1), std::ldexp(1.0, bits - 1) - 1.0};
  return {0.0, std::ldexp(1.0, bits) - 1.0};
}

double as_float(double value) {
  constexpr auto most = static_cast<double>(std::numeric_limits<float>::max());
  return std::abs(value) > most ? value : static_cast<double>(static_cast<float>(value));
}

/// Files write the values that fill them in decimals: both may be rounded to floats. What is larger than any
/// height is one value for each sign.
bool is_same(double stored, double nodata) {
  if (stored == nodata || as_float(stored) == as_float(nodata)) return true;
  return std::abs(nodata) > limits::raster_fill_min && std::abs(stored) > limits::raster_fill_min &&
         (stored < 0.0) == (nodata < 0.0);
}

}  // namespace

HeightValues::HeightValues(GDALRasterBand& band, HeightUnit unit)
    : band_(&band), type_(band.GetRasterDataType()), unit_(std::move(unit)) {
  const char* const pixels = band.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE");
  signed_bytes_ = type_ == GDT_Byte && pixels != nullptr && EQUAL(pixels, "SIGNEDBYTE");
  const int mask = band.GetMaskFlags();
  masked_ = (mask & GMF_PER_DATASET) != 0 || (mask & (GMF_ALL_VALID | GMF_NODATA)) == 0;
  alpha_ = (mask & GMF_ALPHA) != 0;
}

Result<HeightValues> HeightValues::of(GDALRasterBand& band, const RasterChoice& choice, HeightUnit unit) {
  HeightValues values(band, std::move(unit));
  TRY(values.read_scale());
  if (!choice.no_nodata) values.read_declared();
  for (const double value : choice.nodata) values.add_nodata(value);
  return values;
}

Result<void> HeightValues::read_scale() {
  int known = 0;
  const double scale = band_->GetScale(&known);
  if (known != 0) scale_ = scale;
  const double offset = band_->GetOffset(&known);
  if (known != 0) offset_ = offset;
  if (!std::isfinite(scale_) || !std::isfinite(offset_) || scale_ == 0.0)
    return fail(
        fmt::format("its heights would be its values × {:.6g} + {:.6g}, by the scale and the offset "
                    "that the file declares",
                    scale_, offset_));
  return {};
}

void HeightValues::read_declared() {
  int known = 0;
  double value = 0.0;
  if (type_ == GDT_Int64)
    value = static_cast<double>(band_->GetNoDataValueAsInt64(&known));
  else if (type_ == GDT_UInt64)
    value = static_cast<double>(band_->GetNoDataValueAsUInt64(&known));
  else
    value = band_->GetNoDataValue(&known);
  if (known != 0) add_nodata(value);
}

void HeightValues::add_nodata(double value) {
  if (std::isnan(value)) return;  // never a height
  if (is_integer(type_)) {
    const auto [lowest, highest] = range_of(type_, signed_bytes_);
    if (signed_bytes_ && value > highest && value < 256.0) value -= 256.0;
    if (value < lowest || value > highest || value != std::round(value)) {
      misdeclared_.push_back(value);
      return;
    }
  }
  nodata_.push_back(value);
}

bool HeightValues::is_none(double stored) const {
  return !std::isfinite(stored) ||
         std::ranges::any_of(nodata_, [&](double nodata) { return is_same(stored, nodata); });
}

Result<void> HeightValues::read_stored(int column, int row, int columns, int rows, std::span<double> stored) {
  CPLErrorReset();
  const auto read_from = [&](GDALRasterBand& band, void* into, GDALDataType type) {
    return band.RasterIO(GF_Read, column, row, columns, rows, into, columns, rows, type, 0, 0, nullptr) ==
               CE_None &&
           CPLGetLastErrorType() != CE_Failure;
  };
  bool read = read_from(*band_, stored.data(), GDT_Float64);
  if (read && masked_) {
    mask_.resize(stored.size());
    read = read_from(*band_->GetMaskBand(), mask_.data(), GDT_Byte);
  }
  if (!read)
    return fail("row " + std::to_string(row) + " cannot be read: " + gdal_words("no reason is given"));
  if (signed_bytes_)
    for (double& value : stored) value -= value > 127.0 ? 256.0 : 0.0;
  for (double& value : stored)
    if (is_none(value)) value = no_height;
  if (masked_)
    for (size_t i = 0; i < stored.size(); ++i)
      if (mask_[i] == 0) stored[i] = no_height;
  return {};
}

Result<void> HeightValues::read(int column, int row, int columns, int rows, std::span<double> heights_m) {
  TRY(read_stored(column, row, columns, rows, heights_m));
  for (double& value : heights_m) value = height_m(value);
  return {};
}

std::string HeightValues::text_of(double stored) const {
  if (type_ == GDT_Float32 && std::abs(stored) <= static_cast<double>(std::numeric_limits<float>::max()))
    return fmt::format("{}", static_cast<float>(stored));
  return fmt::format("{}", stored);
}

std::vector<std::string> HeightValues::words() const {
  std::vector<std::string> parts;
  std::string heights = "heights " + unit_.words;
  if (scale_ != 1.0 || offset_ != 0.0)
    heights += fmt::format(", its values × {:.6g} + {:.6g}", scale_, offset_);
  if (is_integer(type_) && GDALGetDataTypeSizeBits(type_) == 8) heights += ", of 8 bits";
  parts.push_back(std::move(heights));
  std::string none;
  for (const double value : nodata_)
    none += fmt::format("{}{}", none.empty() ? "nodata " : " and ", text_of(value));
  if (masked_)
    none += fmt::format("{}{}", none.empty() ? "nodata" : " and", alpha_ ? " by alpha" : " by a mask");
  parts.push_back(none.empty() ? "no nodata is declared" : none);
  for (const double value : misdeclared_)
    parts.push_back(fmt::format("no cell can hold the nodata {}", value));
  return parts;
}

}  // namespace scree
