#pragma once

#include <chrono>
#include <cstdint>

namespace scree {

/// Seconds since 1970, by which tokens and bans end.
inline uint64_t unix_now_s() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::seconds>(now).count());
}

}  // namespace scree
