// An adaptive binary range coder: a bit takes as much room as it is unexpected, and each context learns what
// to expect. As in LZMA (Pavlov, "LZMA specification"), but probabilities of 16 bits, which learn fast at
// first, and no bytes that say nothing. Specified in docs/motions.md. Internal to proto/.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace scree {

/// What is known of a context's bits.
class BitModel {
 public:
  /// `ones_in_64`: expected ones, 1 to 63.
  constexpr explicit BitModel(uint32_t ones_in_64 = 32) : one_(ones_in_64 << 10U) {}

  /// Probability of a one, in 1/4096; 1 to 4,095.
  uint32_t one() const { return one_ >> 4U; }
  void learn(bool bit) {
    const int32_t target = bit ? 65520 : 16;
    const auto now = static_cast<int32_t>(one_);
    one_ = static_cast<uint32_t>(now + (((target - now) * (256 / (seen_ + 3))) >> 8));
    if (seen_ < seen_max) ++seen_;
  }

 private:
  static constexpr int32_t seen_max = 29;
  uint32_t one_;
  int32_t seen_ = 0;
};

/// Appends to `bytes`, which must outlive it.
class RangeEncoder {
 public:
  explicit RangeEncoder(std::vector<uint8_t>& bytes) : bytes_(bytes), begin_(bytes.size()) {}

  void bit(BitModel& model, bool bit) {
    split(model.one(), bit);
    model.learn(bit);
  }
  /// The `count` lowest bits of the value, the highest first, at a bit each.
  void plain(uint32_t value, uint32_t count) {
    while (count-- > 0) split(2048, ((value >> count) & 1U) != 0);
  }
  /// Call once, at the end.
  void finish();

 private:
  void split(uint32_t one, bool bit) {
    const uint32_t bound = (range_ >> 12U) * one;
    if (bit) {
      range_ = bound;
    } else {
      low_ += bound;
      range_ -= bound;
    }
    while (range_ < (1U << 24U)) {
      range_ <<= 8U;
      shift();
    }
  }
  void shift() {
    if (low_ >> 32U != 0) carry();
    bytes_.push_back(static_cast<uint8_t>(low_ >> 24U));
    low_ = (low_ << 8U) & 0xFFFFFFFFU;
  }
  void carry();

  std::vector<uint8_t>& bytes_;
  size_t begin_;
  uint64_t low_ = 0;
  uint32_t range_ = 0xFFFFFFFFU;
};

/// Any bytes decode to something: after the last one it reads zeros.
class RangeDecoder {
 public:
  explicit RangeDecoder(std::span<const uint8_t> bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) code_ = (code_ << 8U) | next();
  }

  bool bit(BitModel& model) {
    const bool bit = split(model.one());
    model.learn(bit);
    return bit;
  }
  uint32_t plain(uint32_t count) {
    uint32_t value = 0;
    while (count-- > 0) value = (value << 1U) | (split(2048) ? 1U : 0U);
    return value;
  }
  /// Whether every byte was needed.
  bool at_end() const { return next_ >= bytes_.size(); }

 private:
  bool split(uint32_t one) {
    const uint32_t bound = (range_ >> 12U) * one;
    const bool bit = code_ < bound;
    if (bit) {
      range_ = bound;
    } else {
      code_ -= bound;
      range_ -= bound;
    }
    while (range_ < (1U << 24U)) {
      range_ <<= 8U;
      code_ = (code_ << 8U) | next();
    }
    return bit;
  }
  uint32_t next() { return next_ < bytes_.size() ? bytes_[next_++] : 0U; }

  std::span<const uint8_t> bytes_;
  size_t next_ = 0;
  uint32_t code_ = 0;
  uint32_t range_ = 0xFFFFFFFFU;
};

}  // namespace scree
