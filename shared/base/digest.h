// SHA-256 of bytes: names what cannot be known by its place, so that nobody can pass other bytes off as it.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace scree {

using Digest = std::array<uint8_t, 32>;

/// 64 hexadecimal digits.
inline std::string hex_of(const Digest& digest) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const uint8_t byte : digest) {
    text.push_back(digits[byte >> 4U]);
    text.push_back(digits[byte & 15U]);
  }
  return text;
}

}  // namespace scree
