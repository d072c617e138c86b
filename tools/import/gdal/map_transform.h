// The affine way from cells of a raster to a map: GDAL's geotransform.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "tools/import/gdal/dataset.h"

namespace scree {

/// x = t[0] + column t[1] + row t[2]; y = t[3] + column t[4] + row t[5]. Cells have their corners at whole
/// numbers.
struct MapTransform {
  std::array<double, 6> t{0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

  std::array<double, 2> at(double column, double row) const {
    return {t[0] + column * t[1] + row * t[2], t[3] + column * t[4] + row * t[5]};
  }
  bool is_finite() const;
  bool has_area() const;
  /// Whether rows run along x or against it, within a twentieth of a cell.
  bool is_straight(int columns, int rows) const;
  /// Whether columns do.
  bool is_quarter_turned(int columns, int rows) const;
};

/// The transform of the file, or of ground control points that lie exactly so; nothing where it has neither.
std::optional<MapTransform> map_transform_of(GDALDataset& dataset);

}  // namespace scree
