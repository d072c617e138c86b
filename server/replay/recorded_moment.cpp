#include "server/replay/recorded_moment.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace scree {

namespace {

constexpr double moment_max = 1e15;

/// Digits, with a point perhaps: no sign, exponent or name, which strtod() would take.
std::optional<double> plain_number(const std::string& text) {
  const bool has_digit = text.find_first_of("0123456789") != std::string::npos;
  const bool plain = text.find_first_not_of("0123456789.") == std::string::npos;
  if (!has_digit || !plain || text.find('.') != text.rfind('.')) return std::nullopt;
  return std::strtod(text.c_str(), nullptr);
}

/// "1:30", hours before minutes before seconds; of one part alone, that.
std::optional<double> sum_of_parts(const std::string& text) {
  double sum = 0.0;
  size_t parts = 0;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(':', begin), text.size());
    const auto number = plain_number(text.substr(begin, end - begin));
    if (!number || ++parts > 3) return std::nullopt;
    sum = sum * 60.0 + *number;
    begin = end + 1;
  }
  return sum;
}

}  // namespace

Tick TickOrTime::nearest_tick(uint32_t tick_rate_hz) const {
  return static_cast<Tick>(std::llround(tick(tick_rate_hz)));
}

Result<TickOrTime> parse_tick_or_time(const std::string& text) {
  const auto refused =
      fail(fmt::format("'{}' is not a moment: write a tick, as 5400, or a time, as 90s, 1.5m or 1:30", text));
  if (text.empty()) return refused;
  const bool is_tick = text.find_first_not_of("0123456789") == std::string::npos;
  const size_t unit = std::string_view("smh").find(text.back());
  const bool has_unit = unit != std::string_view::npos;
  if (!is_tick && !has_unit && text.find(':') == std::string::npos) return refused;  // 1.5 of what?
  const auto number = sum_of_parts(has_unit ? text.substr(0, text.size() - 1) : text);
  if (!number) return refused;
  const double value = has_unit ? *number * std::pow(60.0, static_cast<double>(unit)) : *number;
  if (!(value < moment_max)) return refused;
  return TickOrTime{value, !is_tick};
}

}  // namespace scree
