#include "shared/base/length_of_time.h"

#include <array>
#include <charconv>
#include <cstdint>

namespace scree {

namespace {

struct TimeUnit {
  char letter;
  uint64_t seconds;
};
constexpr std::array time_units = {TimeUnit{'d', 86'400}, TimeUnit{'h', 3'600}, TimeUnit{'m', 60},
                                   TimeUnit{'s', 1}};

}  // namespace

std::string length_text(double seconds) {
  const auto whole = static_cast<uint64_t>(seconds);
  for (const TimeUnit& unit : time_units)
    if (whole != 0 && whole % unit.seconds == 0) return std::to_string(whole / unit.seconds) + unit.letter;
  return std::to_string(whole) + "s";
}

Result<double> seconds_of(const std::string& text, double least_s, double most_s) {
  const auto refused = [&] {
    return fail("'" + text + "' is not a length of time from " + length_text(least_s) + " to " +
                length_text(most_s) + ": write a whole number and s, m, h or d");
  };
  if (text.size() < 2) return refused();
  uint32_t number = 0;
  const char* const end = text.data() + text.size() - 1;
  const auto [read, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || read != end) return refused();
  for (const TimeUnit& unit : time_units) {
    if (unit.letter != text.back()) continue;
    const double seconds = static_cast<double>(number) * static_cast<double>(unit.seconds);
    if (seconds < least_s || seconds > most_s) return refused();
    return seconds;
  }
  return refused();
}

}  // namespace scree
