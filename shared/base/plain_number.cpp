#include "shared/base/plain_number.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace scree {

namespace {

constexpr double most_written = 1e15, digits_of_floats = 1e7;
constexpr int digits_wanted = 5, decimals_most = 7;

/// To the digits that a float has.
double to_float_digits(double number) {
  double step = 1.0;
  while (std::abs(number) / step >= digits_of_floats) step *= 10.0;
  return step == 1.0 ? number : std::round(number / step) * step;
}

int decimals_of(double size) {
  int decimals = digits_wanted - 1;
  for (double step = 10.0; size >= step && decimals > 0; step *= 10.0) --decimals;
  for (double step = 1.0; size < step && decimals < decimals_most; step /= 10.0) ++decimals;
  return decimals;
}

/// Commas between the thousands of a number that has five digits or more before its point.
std::string grouped(const std::string& text) {
  const size_t first = text[0] == '-' ? 1 : 0;
  const size_t point = std::min(text.find('.'), text.size());
  if (point - first < 5) return text;
  std::string spaced;
  for (size_t i = 0; i < text.size(); ++i) {
    if (i > first && i < point && (point - i) % 3 == 0) spaced += ',';
    spaced += text[i];
  }
  return spaced;
}

}  // namespace

std::string plain(double number) {
  if (!std::isfinite(number)) return "no number";
  if (std::abs(number) >= most_written) return number < 0.0 ? "less than -10^15" : "more than 10^15";
  char digits[64];
  std::snprintf(digits, sizeof digits, "%.*f", decimals_of(std::abs(number)), to_float_digits(number));
  std::string text(digits);
  if (text.find('.') != std::string::npos) {
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : grouped(text);
}

std::string with_unit(double number, const std::string& unit) {
  return unit.empty() || !std::isfinite(number) ? plain(number) : plain(number) + " " + unit;
}

std::string metres(double length) {
  return with_unit(length, "m");
}

std::string range_text(double least, double most, const std::string& unit) {
  return "from " + plain(least) + " to " + with_unit(most, unit);
}

}  // namespace scree
