#include "studies/scale/power_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr double flat_exponent = 0.05;
constexpr double beyond_max = 100.0;

/// Sums over logarithms of points.
struct LogSums {
  double n = 0.0, x = 0.0, y = 0.0;

  explicit LogSums(std::span<const ScalePoint> points) {
    for (const ScalePoint& point : points) {
      n += 1.0;
      x += std::log(point.size);
      y += std::log(point.value);
    }
  }
};

/// Size at which the straight line through two points, in logarithms, has the value.
double between(const ScalePoint& a, const ScalePoint& b, double value) {
  const double part = std::log(value / a.value) / std::log(b.value / a.value);
  return a.size * std::pow(b.size / a.size, part);
}

}  // namespace

double PowerLaw::at(double size) const {
  return factor * std::pow(size, exponent);
}

double student_t(size_t degrees) {
  CHECK(degrees > 0);
  constexpr std::array exact = {12.706, 4.3027, 3.1824, 2.7764, 2.5706,
                                2.4469, 2.3646, 2.3060, 2.2622, 2.2281};
  if (degrees <= exact.size()) return exact[degrees - 1];
  // Expansion in 1 / degrees (Cornish and Fisher 1938).
  constexpr double z = 1.959964;
  constexpr double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
  const double v = static_cast<double>(degrees);
  return z + (z3 + z) / (4.0 * v) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * v * v) +
         (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * v * v * v);
}

std::optional<PowerLaw> fit_power_law(std::span<const ScalePoint> all) {
  std::vector<ScalePoint> points;
  for (const ScalePoint& point : all)
    if (point.size > 0.0 && point.value > 0.0) points.push_back(point);
  const auto [least, most] = std::ranges::minmax_element(points, {}, &ScalePoint::size);
  if (points.empty() || least->size == most->size) return std::nullopt;
  const LogSums sums(points);
  const double mean_x = sums.x / sums.n, mean_y = sums.y / sums.n;
  double xx = 0.0, xy = 0.0;
  for (const ScalePoint& point : points) {
    const double x = std::log(point.size) - mean_x;
    xx += x * x;
    xy += x * (std::log(point.value) - mean_y);
  }
  PowerLaw law;
  law.exponent = xy / xx;
  law.factor = std::exp(mean_y - law.exponent * mean_x);
  if (points.size() == 2) {
    law.within = std::numeric_limits<double>::infinity();
    return law;
  }
  double squares = 0.0;
  for (const ScalePoint& point : points) {
    const double off = std::log(point.value / law.at(point.size));
    squares += off * off;
  }
  const size_t degrees = points.size() - 2;
  law.within = student_t(degrees) * std::sqrt(squares / static_cast<double>(degrees) / xx);
  return law;
}

std::optional<Crossing> crossing(std::span<const ScalePoint> ordered, double limit) {
  const auto law = fit_power_law(ordered);
  if (!law) return std::nullopt;
  std::vector<ScalePoint> points(ordered.begin(), ordered.end());
  if (law->exponent < 0.0) std::ranges::reverse(points);
  if (points.front().value >= limit) return Crossing{points.front().size, true};
  for (size_t i = 1; i < points.size(); ++i)
    if (points[i].value >= limit) return Crossing{between(points[i - 1], points[i], limit), true};
  const auto end = fit_power_law(std::span(points).last(std::min<size_t>(3, points.size())));
  if (!end || std::abs(end->exponent) <= flat_exponent || (end->exponent < 0.0) != (law->exponent < 0.0))
    return std::nullopt;
  const ScalePoint& last = points.back();
  const double times = std::pow(limit / last.value, 1.0 / end->exponent);
  if (std::max(times, 1.0 / times) > beyond_max) return std::nullopt;
  return Crossing{last.size * times, false};
}

}  // namespace scree
