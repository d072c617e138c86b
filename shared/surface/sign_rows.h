// Rows of voxels along z as words of sign bits, and the cells between four rows. Pure.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "shared/base/check.h"
#include "shared/field/brick.h"

namespace scree {

static_assert(std::endian::native == std::endian::little, "sign_bits reads eight codes as one word");

/// Bit i: byte i is negative.
inline uint64_t eight_signs(const Code* codes) {
  uint64_t word;
  std::memcpy(&word, codes, sizeof(word));
  return ((word & 0x8080808080808080ULL) * 0x0002040810204081ULL) >> 56U;
}

#ifdef __SSE2__
/// The same of sixteen, by one instruction of every x86-64.
inline uint64_t sixteen_signs(const Code* codes) {
  const __m128i word = _mm_loadu_si128(reinterpret_cast<const __m128i*>(codes));
  return static_cast<uint32_t>(_mm_movemask_epi8(word));
}
#endif

/// Bit i: codes[i] is rock. 8 <= count <= 64.
inline uint64_t sign_bits(const Code* codes, int count) {
  CHECK_DEBUG(count >= 8 && count <= 64);
  uint64_t bits = 0;
#ifdef __SSE2__
  if (count >= 16) {
    for (int i = 0; i + 16 < count; i += 16) bits |= sixteen_signs(codes + i) << i;
    return bits | (sixteen_signs(codes + count - 16) << (count - 16));
  }
#endif
  for (int i = 0; i + 8 < count; i += 8) bits |= eight_signs(codes + i) << i;
  return bits | (eight_signs(codes + count - 8) << (count - 8));
}

/// The four rows of voxels around a row of cells, as sign bits.
struct SignRows {
  uint64_t r00, r01, r10, r11;

  /// Cells that the surface crosses.
  uint64_t active() const {
    const uint64_t any = r00 | r01 | r10 | r11;
    const uint64_t all = r00 & r01 & r10 & r11;
    return (any | (any >> 1U)) & ~(all & (all >> 1U));
  }
  uint32_t signs(int i) const {
    const auto pair = [i](uint64_t row) { return static_cast<uint32_t>(row >> i) & 3U; };
    return pair(r00) | (pair(r01) << 2U) | (pair(r10) << 4U) | (pair(r11) << 6U);
  }
};

}  // namespace scree
