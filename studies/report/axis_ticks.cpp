#include "studies/report/axis_ticks.h"

#include <cmath>
#include <span>

#include "shared/base/check.h"

namespace scree {
namespace {

constexpr size_t ticks_most = 9;  ///< their labels have room
constexpr double rounding = 1e-9;

/// Those of `digits` times a power of ten that lie in the range; `every`: of how many powers one counts.
std::vector<double> multiples(double lo, double hi, std::span<const double> digits, int every = 1) {
  std::vector<double> found;
  const auto first = static_cast<int>(std::floor(std::log10(lo))),
             last = static_cast<int>(std::log10(hi)) + 1;
  for (int power = first; power <= last; ++power) {
    if (power % every != 0) continue;
    for (const double digit : digits) {
      // Below 1 by division: 0.2 is 2 / 10, not 2 · 0.1.
      const double at = power < 0 ? digit / std::pow(10.0, -power) : digit * std::pow(10.0, power);
      if (at >= lo * (1.0 - rounding) && at <= hi * (1.0 + rounding)) found.push_back(at);
    }
  }
  return found;
}

/// The same distance apart, which is 1, 2 or 5 times a power of ten.
std::vector<double> equally_apart(double lo, double hi) {
  const double power = std::pow(10.0, std::floor(std::log10(hi - lo)));
  for (const double part : {1.0, 0.5, 0.2, 0.1}) {
    const double step = part * power;
    std::vector<double> found;
    for (double number = std::ceil(lo / step - rounding); number * step <= hi + rounding * step;
         number += 1.0)
      found.push_back(number * step);
    if (found.size() >= ticks_least) return found;
  }
  return {lo, hi};
}

}  // namespace

std::vector<double> log_ticks(double lo, double hi) {
  CHECK(lo > 0.0 && hi > lo);
  constexpr double one[] = {1.0}, three[] = {1.0, 2.0, 5.0},
                   all[] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0};
  std::vector<double> ticks = multiples(lo, hi, one);
  for (int every = 2; ticks.size() > ticks_most; ++every) ticks = multiples(lo, hi, one, every);
  if (ticks.size() < ticks_least) ticks = multiples(lo, hi, three);
  if (ticks.size() < ticks_least) ticks = multiples(lo, hi, all);
  return ticks.size() < ticks_least ? equally_apart(lo, hi) : ticks;
}

std::pair<double, double> round_log_range(double lo, double hi) {
  CHECK(lo > 0.0 && hi >= lo);
  constexpr double digits[] = {1.0, 2.0, 5.0};
  const std::vector<double> below = multiples(lo / 10.0, lo, digits),
                            above = multiples(hi, hi * 10.0, digits);
  if (below.back() < above.front()) return {below.back(), above.front()};
  return {below.at(below.size() - 2), above.at(1)};  // both are the same round number
}

}  // namespace scree
