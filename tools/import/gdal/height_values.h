// From the numbers that a band stores to heights in metres: which numbers are no heights, scale and offset,
// unit. One thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/import/gdal/height_unit.h"
#include "tools/import/raster_choice.h"

namespace scree {

class HeightValues {
 public:
  /// `band` outlives it.
  static Result<HeightValues> of(GDALRasterBand& band, const RasterChoice& choice, HeightUnit unit);

  GDALRasterBand& band() const { return *band_; }
  /// The stored numbers of a box of cells, row by row; NaN where there is no height.
  Result<void> read_stored(int column, int row, int columns, int rows, std::span<double> stored);
  /// Heights in metres instead; NaN stays.
  Result<void> read(int column, int row, int columns, int rows, std::span<double> heights_m);
  double height_m(double stored) const { return (stored * scale_ + offset_) * unit_.metres; }
  /// Values that the file or the command line says are none, and that its type cannot store as they are.
  const std::vector<double>& misdeclared() const { return misdeclared_; }
  /// As a number of the file's type is written, so that reading it gives the same one.
  std::string text_of(double stored) const;
  /// Unit, scale and nodata, as parts of a sentence.
  std::vector<std::string> words() const;

 private:
  HeightValues(GDALRasterBand& band, HeightUnit unit);
  Result<void> read_scale();
  void add_nodata(double value);
  void read_declared();
  bool is_none(double stored) const;

  GDALRasterBand* band_;
  GDALDataType type_;
  bool signed_bytes_ = false;  ///< GDAL reads them as 0 to 255
  HeightUnit unit_;
  double scale_ = 1.0;
  double offset_ = 0.0;
  std::vector<double> nodata_;
  std::vector<double> misdeclared_;
  bool masked_ = false;  ///< a mask or alpha band says which cells have a height
  bool alpha_ = false;
  std::vector<uint8_t> mask_;
};

}  // namespace scree
