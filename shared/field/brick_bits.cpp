#include "shared/field/brick_bits.h"

#include <algorithm>
#include <cstring>

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr uint64_t low_z = 0x0101010101010101U;   ///< z = 0
constexpr uint64_t high_z = 0x8080808080808080U;  ///< z = 7

/// Sign bits of eight codes, the first in bit 0.
uint64_t signs(const Code* row) {
  static_assert(std::endian::native == std::endian::little);
  uint64_t codes = 0;
  std::memcpy(&codes, row, sizeof(codes));
  // Each code's sign lands in another bit of the top byte, without carries.
  return (((codes & high_z) >> 7U) * 0x0102040810204080U) >> 56U;
}

}  // namespace

BrickBits solid_bits(const Brick& brick) {
  BrickBits bits;
  if (&brick == &air_brick()) return bits;
  if (&brick == &solid_brick()) return ~bits;
  for (size_t x = 0; x < brick_size; ++x)
    for (size_t y = 0; y < brick_size; ++y)
      bits.words[x] |= signs(brick.codes.data() + (x * brick_size + y) * brick_size) << (y * brick_size);
  return bits;
}

BrickBits across(const BrickBits& bits, size_t face) {
  CHECK_DEBUG(face < brick_faces.size());
  BrickBits out;
  for (size_t i = 0; i < bits.words.size(); ++i) {
    const uint64_t word = bits.words[i];
    switch (face) {
      case 0:
        out.words[0] = bits.words[7];
        break;
      case 1:
        out.words[7] = bits.words[0];
        break;
      case 2:
        out.words[i] = word >> 56U;
        break;
      case 3:
        out.words[i] = word << 56U;
        break;
      case 4:
        out.words[i] = (word & high_z) >> 7U;
        break;
      default:
        out.words[i] = (word & low_z) << 7U;
        break;
    }
  }
  return out;
}

BrickBits flooded(const BrickBits& from, const BrickBits& solid) {
  BrickBits bits = from & solid;
  for (bool grew = true; grew;) {
    grew = false;
    for (size_t x = 0; x < bits.words.size(); ++x) {
      const uint64_t word = bits.words[x];
      uint64_t next = word | (word << 8U) | (word >> 8U) | ((word & ~high_z) << 1U) | ((word & ~low_z) >> 1U);
      if (x > 0) next |= bits.words[x - 1];
      if (x + 1 < bits.words.size()) next |= bits.words[x + 1];
      next &= solid.words[x];
      grew = grew || next != word;
      bits.words[x] = next;
    }
  }
  return bits;
}

BrickBits first_of(const BrickBits& bits) {
  BrickBits first;
  for (size_t x = 0; x < bits.words.size(); ++x)
    if (bits.words[x] != 0) {
      first.words[x] = bits.words[x] & (~bits.words[x] + 1);
      return first;
    }
  CHECK(false);
}

VoxelBox bounds_of(const BrickBits& bits) {
  CHECK_DEBUG(bits.any());
  VoxelBox box{{brick_size, brick_size, brick_size}, {0, 0, 0}};
  for (int x = 0; x < brick_size; ++x) {
    const uint64_t word = bits.words[static_cast<size_t>(x)];
    if (word == 0) continue;
    box.lo.x = std::min(box.lo.x, x);
    box.hi.x = x + 1;
    box.lo.y = std::min(box.lo.y, std::countr_zero(word) / brick_size);
    box.hi.y = std::max(box.hi.y, (63 - std::countl_zero(word)) / brick_size + 1);
    uint64_t columns = word | (word >> 32U);
    columns |= columns >> 16U;
    columns = (columns | (columns >> 8U)) & 0xFFU;
    box.lo.z = std::min(box.lo.z, std::countr_zero(columns));
    box.hi.z = std::max(box.hi.z, 64 - std::countl_zero(columns));
  }
  return box;
}

}  // namespace scree
