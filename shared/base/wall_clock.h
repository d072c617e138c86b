// The time of day, for people: when an event happened, since when something fails. The simulation never uses
// it.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <string>

namespace scree {

/// Milliseconds since 1970, UTC.
inline uint64_t unix_now_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

/// As ISO 8601 in UTC: "2026-11-25T23:12:28.123Z". Times after the year 9999 are not shown.
inline std::string iso_time(uint64_t unix_ms) {
  constexpr uint64_t ms_per_s = 1000;
  constexpr uint64_t last_s = 253'402'300'799;  // 9999-12-31T23:59:59Z
  if (unix_ms / ms_per_s > last_s) return {};
  const auto seconds = static_cast<std::time_t>(unix_ms / ms_per_s);
  std::tm utc{};
  if (gmtime_r(&seconds, &utc) == nullptr) return {};
  std::array<char, 32> text{};
  const size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  std::snprintf(text.data() + length, text.size() - length, ".%03uZ",
                static_cast<unsigned>(unix_ms % ms_per_s));
  return text.data();
}

}  // namespace scree
