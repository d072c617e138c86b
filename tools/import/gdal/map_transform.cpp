#include "tools/import/gdal/map_transform.h"

#include <algorithm>
#include <cmath>
#include <gdal.h>

namespace scree {

namespace {

/// In cells, over the whole raster.
constexpr double skew_cells_max = 0.05;

}  // namespace

bool MapTransform::is_finite() const {
  return std::ranges::all_of(t, [](double number) { return std::isfinite(number); });
}

bool MapTransform::has_area() const {
  const double area = std::abs(t[1] * t[5] - t[2] * t[4]);
  return area > 1.0e-6 * std::hypot(t[1], t[4]) * std::hypot(t[2], t[5]);
}

bool MapTransform::is_straight(int columns, int rows) const {
  return std::abs(t[2]) * rows <= skew_cells_max * std::abs(t[1]) &&
         std::abs(t[4]) * columns <= skew_cells_max * std::abs(t[5]);
}

bool MapTransform::is_quarter_turned(int columns, int rows) const {
  return std::abs(t[1]) * columns <= skew_cells_max * std::abs(t[2]) &&
         std::abs(t[5]) * rows <= skew_cells_max * std::abs(t[4]);
}

std::optional<MapTransform> map_transform_of(GDALDataset& dataset) {
  MapTransform transform;
  if (dataset.GetGeoTransform(transform.t.data()) == CE_None) return transform;
  if (dataset.GetGCPCount() >= 3 &&
      GDALGCPsToGeoTransform(dataset.GetGCPCount(), dataset.GetGCPs(), transform.t.data(), FALSE) != 0)
    return transform;
  return std::nullopt;
}

}  // namespace scree
