// Heights from a file, row by row, from north to south.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/base/result.h"

namespace scree {

class Raster {
 public:
  struct Shape {
    int columns = 0;
    int rows = 0;
    /// Distance of samples, metres; nothing where the file does not say.
    std::optional<double> cell_x_m;
    std::optional<double> cell_z_m;
  };
  /// Where the middle of the raster lies on the map.
  struct Place {
    std::string crs;
    double x = 0.0;
    double y = 0.0;
  };

  virtual ~Raster() = default;
  virtual Shape shape() const = 0;
  /// Reads everything once, before the rows. Refuses values that are no heights although nothing says so.
  virtual Result<void> check_values(const std::function<void(double)>&) { return {}; }
  /// Metres by the file's own scale; NaN where it has no height. As many as there are columns.
  virtual Result<void> read_row(int row, std::span<double> heights_m) = 0;
  virtual std::optional<Place> place() const { return std::nullopt; }
  /// Sentences on what the file says, and on what was assumed where it says nothing.
  virtual std::vector<std::string> said() { return {}; }
};

}  // namespace scree
