// Questions to eight codes, or masses of voxels, at once: as one word. Most of a window is air.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>

#include "shared/base/check.h"
#include "shared/field/brick.h"

namespace scree {

/// Whether one of the eight codes is below the limit, 1 to 127.
inline bool any_below(const Code* eight, Code limit) {
  CHECK_DEBUG(limit >= 1);
  constexpr uint64_t ones = 0x0101010101010101U, signs = 0x80U * ones;
  uint64_t word;
  std::memcpy(&word, eight, sizeof(word));
  // The sum's top bits say which codes are not below, if they are not negative; there is no carry.
  const uint64_t sum = (word & ~signs) + (128U - static_cast<uint64_t>(limit)) * ones;
  return ((~sum | word) & signs) != 0;
}

/// Whether one of the eight codes is negative.
inline bool any_solid(const Code* eight) {
  constexpr uint64_t signs = 0x8080808080808080U;
  uint64_t word;
  std::memcpy(&word, eight, sizeof(word));
  return (word & signs) != 0;
}

inline bool all_zero(const uint8_t* eight) {
  uint64_t word;
  std::memcpy(&word, eight, sizeof(word));
  return word == 0;
}

/// Calls f(index) for each byte that is not 0.
template <typename F>
void for_each_nonzero(std::span<const uint8_t> bytes, F&& f) {
  for (size_t from = 0; from < bytes.size(); from += 8) {
    const size_t to = std::min(from + 8, bytes.size());
    if (to - from == 8 && all_zero(&bytes[from])) continue;
    for (size_t i = from; i < to; ++i)
      if (bytes[i] != 0) f(i);
  }
}

}  // namespace scree
