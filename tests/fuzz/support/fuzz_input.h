// Reads a fuzzer's bytes as the choices of which a target derives what it does. After the last byte
// everything reads as zero, so that every input means something. Not thread-safe.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <type_traits>

#include "shared/base/check.h"

namespace scree {

class FuzzInput {
 public:
  explicit FuzzInput(std::span<const uint8_t> bytes) : bytes_(bytes) {}
  FuzzInput(const uint8_t* data, size_t size) : bytes_(data, size) {}

  bool at_end() const { return next_ == bytes_.size(); }

  uint8_t byte() { return at_end() ? uint8_t{0} : bytes_[next_++]; }
  bool flag() { return (byte() & 1U) != 0; }
  /// Uniform in [0, bound), of one byte; 0 < bound ≤ 256.
  uint32_t below(uint32_t bound) {
    CHECK(bound > 0 && bound <= 256);
    return byte() % bound;
  }
  /// Any value of the type, little-endian; of a float any bits, NaN too.
  template <typename Number>
  Number number() {
    static_assert(std::is_arithmetic_v<Number>);
    Number value{};
    const std::span<const uint8_t> taken = bytes(sizeof value);
    std::memcpy(&value, taken.data(), taken.size());
    return value;
  }
  /// One of 65536 values from min to max.
  float between(float min, float max) {
    return min + (max - min) * static_cast<float>(number<uint16_t>()) / 65535.0F;
  }
  /// Mostly between ± span; one in 32 has any bits.
  float coordinate(float span) { return below(32) == 31 ? number<float>() : between(-span, span); }
  glm::vec3 place(float span) {
    const float x = coordinate(span);
    const float y = coordinate(span);
    return {x, y, coordinate(span)};
  }
  /// As many bytes, or those that are left.
  std::span<const uint8_t> bytes(size_t count) {
    const std::span<const uint8_t> taken = bytes_.subspan(next_, std::min(count, bytes_.size() - next_));
    next_ += taken.size();
    return taken;
  }
  /// A length of two bytes, and that many bytes.
  std::span<const uint8_t> packet() {
    const auto length = number<uint16_t>();
    return bytes(length);
  }
  std::string text(size_t bytes_max) {
    const std::span<const uint8_t> taken = bytes(std::min<size_t>(byte(), bytes_max));
    return {taken.begin(), taken.end()};
  }
  std::span<const uint8_t> rest() { return bytes(bytes_.size()); }

 private:
  std::span<const uint8_t> bytes_;
  size_t next_ = 0;
};

}  // namespace scree
