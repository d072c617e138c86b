// Power laws y = factor · x^exponent: least squares of log y over log x, with the interval in which the
// exponent lies by Student's t, and where a measured curve meets a limit.
#pragma once

#include <optional>
#include <span>

namespace scree {

/// What was measured at a size; both are positive.
struct ScalePoint {
  double size = 0.0;
  double value = 0.0;

  bool operator==(const ScalePoint&) const = default;
};

struct PowerLaw {
  double factor = 0.0;
  double exponent = 0.0;
  double within = 0.0;  ///< half of the exponent's 95 % interval; infinite of two points

  double at(double size) const;
};

/// Points whose size or value is not positive are left out. Nothing of fewer than two sizes.
std::optional<PowerLaw> fit_power_law(std::span<const ScalePoint> points);

/// 97.5 % quantile of Student's t for so many degrees of freedom, which are positive: within 0.1 %.
double student_t(size_t degrees);

/// Where a curve meets a limit.
struct Crossing {
  double size = 0.0;
  bool measured =
      false;  ///< between points, or at the first; else beyond the last, by the law of the last three
};

/// The first crossing on the way on which values rise: towards larger sizes, or towards smaller ones. Nothing
/// when the curve's end is flat (an exponent of 0.05 or less) below the limit, or so far from it that the
/// crossing would lie more than a hundred times beyond the last point. `points` are ordered by size.
std::optional<Crossing> crossing(std::span<const ScalePoint> points, double limit);

}  // namespace scree
