// Heights from a file, row by row, from north to south.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

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

  virtual ~Raster() = default;
  virtual Shape shape() const = 0;
  /// Metres by the file's own scale; NaN where it has no height. As many as there are columns.
  virtual Result<void> read_row(int row, std::span<double> heights_m) = 0;
};

}  // namespace scree
