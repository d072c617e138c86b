#include "auth/duration_text.h"

#include <charconv>

namespace scree {

namespace {

constexpr uint64_t seconds_max = 3660ULL * 24 * 3600;

uint64_t seconds_in(char unit) {
  switch (unit) {
    case 's':
      return 1;
    case 'm':
      return 60;
    case 'h':
      return 3600;
    case 'd':
      return 24 * 3600;
    default:
      return 0;
  }
}

}  // namespace

Result<uint64_t> read_duration_s(const std::string& text) {
  uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [unit, error] = std::from_chars(text.data(), end, number);
  const uint64_t factor = unit + 1 == end ? seconds_in(*unit) : 0;
  if (error != std::errc() || factor == 0)
    return fail("'" + text + "' is not a length of time: write 30d, 12h, 45m or 90s");
  if (number == 0 || number > seconds_max / factor)
    return fail("'" + text + "' is not within 1s and ten years");
  return number * factor;
}

}  // namespace scree
