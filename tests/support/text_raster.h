// Rasters for tests: an ESRI ASCII grid as text, and any function.
#pragma once

#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tools/import/raster.h"

namespace scree {

class FunctionRaster final : public Raster {
 public:
  FunctionRaster(int columns, int rows, std::optional<double> cell_m,
                 std::function<double(int, int)> height_m)
      : shape_{columns, rows, cell_m, cell_m}, height_m_(std::move(height_m)) {}

  Shape shape() const override { return shape_; }
  Result<void> read_row(int row, std::span<double> heights_m) override {
    if (row == fails_at) return fail("the disk is gone");
    for (int x = 0; x < shape_.columns; ++x) heights_m[static_cast<size_t>(x)] = height_m_(x, row);
    return {};
  }

  /// Rows lie at another distance than columns.
  void deepen(double cell_z_m) { shape_.cell_z_m = cell_z_m; }

  int fails_at = -1;  ///< row that cannot be read

 private:
  Shape shape_;
  std::function<double(int, int)> height_m_;
};

/// data/maunga_whau.asc of this project, or another grid without nodata whose header has six lines.
inline FunctionRaster read_grid(const std::string& path) {
  std::ifstream file(path);
  std::string word;
  int columns = 0, rows = 0;
  double corner = 0.0, cell_m = 0.0, nodata = 0.0;
  file >> word >> columns >> word >> rows >> word >> corner >> word >> corner >> word >> cell_m >> word >>
      nodata;
  std::vector<double> heights(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  for (double& height : heights) file >> height;
  return {columns, rows, cell_m, [heights, columns](int x, int z) {
            return heights[static_cast<size_t>(z) * static_cast<size_t>(columns) + static_cast<size_t>(x)];
          }};
}

}  // namespace scree
