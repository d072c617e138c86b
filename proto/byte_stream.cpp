#include "proto/byte_stream.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr int width_bits = 5;

uint32_t fold_sign(int32_t value) {
  return (static_cast<uint32_t>(value) << 1U) ^ static_cast<uint32_t>(value >> 31);
}

int32_t unfold_sign(uint32_t value) {
  return static_cast<int32_t>((value >> 1U) ^ (0U - (value & 1U)));
}

}  // namespace

void ByteWriter::u32(uint32_t value) {
  for (int i = 0; i < 4; ++i) u8(static_cast<uint8_t>(value >> (8 * i)));
}

void ByteWriter::u64(uint64_t value) {
  for (int i = 0; i < 8; ++i) u8(static_cast<uint8_t>(value >> (8 * i)));
}

void ByteWriter::varint(uint64_t value) {
  while (value >= 0x80) {
    u8(static_cast<uint8_t>(value | 0x80U));
    value >>= 7U;
  }
  u8(static_cast<uint8_t>(value));
}

void ByteWriter::zigzag(int64_t value) {
  varint(fold_sign(value));
}

void ByteWriter::f32(float value) {
  u32(std::bit_cast<uint32_t>(value));
}

void ByteWriter::vec3(glm::vec3 value) {
  f32(value.x);
  f32(value.y);
  f32(value.z);
}

void ByteWriter::position(const QuantisedPose& pose) {
  const uint32_t folded[3] = {fold_sign(pose.x), fold_sign(pose.y), fold_sign(pose.z)};
  const int width = std::bit_width(folded[0] | folded[1] | folded[2]);
  CHECK(width < 1 << width_bits);
  uint64_t pending = static_cast<uint64_t>(width);
  int pending_bits = width_bits;
  for (const uint32_t value : folded) {
    pending |= static_cast<uint64_t>(value) << pending_bits;  // at most 7 + 31 bits wait at a time
    for (pending_bits += width; pending_bits >= 8; pending_bits -= 8, pending >>= 8U)
      u8(static_cast<uint8_t>(pending));
  }
  CHECK_DEBUG(pending_bits < 8 && pending >> pending_bits == 0);
  if (pending_bits > 0) u8(static_cast<uint8_t>(pending));
}

void ByteReader::refuse(const std::string& reason) {
  if (!failed()) error_.message = fmt::format("{}: {}", subject_, reason);
}

bool ByteReader::advance(size_t count, const char* what) {
  if (failed()) return false;
  if (bytes_.size() - next_ < count) {
    refuse(std::string("ends within ") + what);
    return false;
  }
  next_ += count;
  return true;
}

uint64_t ByteReader::varint(const char* what, uint64_t max) {
  uint64_t value = 0;
  for (unsigned low_bit = 0; low_bit < 64; low_bit += 7) {
    if (!advance(1, what)) return 0;
    const uint8_t byte = bytes_[next_ - 1];
    if (low_bit == 63 && byte > 1) break;
    value |= static_cast<uint64_t>(byte & 0x7FU) << low_bit;
    if ((byte & 0x80U) != 0) continue;
    if (value <= max) return value;
    refuse(fmt::format("{} is {}, over the limit of {}", what, value, max));
    return 0;
  }
  refuse(std::string(what) + " is a varint of more than 64 bits");
  return 0;
}

int64_t ByteReader::zigzag(const char* what, int64_t max) {
  const int64_t value = unfold_sign(varint(what));
  if (value >= -max && value <= max) return value;
  refuse_beyond(value, max, what);
  return 0;
}

uint8_t ByteReader::u8(const char* what, uint8_t max) {
  if (!advance(1, what)) return 0;
  const uint8_t value = bytes_[next_ - 1];
  if (value <= max) return value;
  refuse(fmt::format("{} is {}, over the limit of {}", what, value, max));
  return 0;
}

uint32_t ByteReader::u32(const char* what) {
  if (!advance(4, what)) return 0;
  uint32_t value = 0;
  for (unsigned i = 0; i < 4; ++i) value |= static_cast<uint32_t>(bytes_[next_ - 4 + i]) << (8 * i);
  return value;
}

uint64_t ByteReader::u64(const char* what) {
  const uint64_t low = u32(what);
  return low | uint64_t{u32(what)} << 32U;
}

std::span<const uint8_t> ByteReader::read_bytes(size_t count, const char* what) {
  if (!advance(count, what)) return {};
  return bytes_.subspan(next_ - count, count);
}

float ByteReader::f32(const char* what) {
  const auto value = std::bit_cast<float>(u32(what));
  if (std::isfinite(value)) return value;
  refuse(std::string(what) + " is not a finite number");
  return 0.0F;
}

glm::vec3 ByteReader::vec3(const char* what) {
  const float x = f32(what);
  const float y = f32(what);
  return {x, y, f32(what)};
}

QuantisedPose ByteReader::position(const char* what) {
  uint64_t pending = 0;
  int pending_bits = 0;
  const auto bits = [&](int count) {
    while (pending_bits < count && advance(1, what)) {
      pending |= static_cast<uint64_t>(bytes_[next_ - 1]) << pending_bits;
      pending_bits += 8;
    }
    if (failed()) return uint32_t{0};
    const auto value = static_cast<uint32_t>(pending & ((uint64_t{1} << count) - 1));
    pending >>= static_cast<unsigned>(count);
    pending_bits -= count;
    return value;
  };
  const auto axis = [&](int width) {
    const int32_t value = unfold_sign(bits(width));
    if (value < -limits::pose_coordinate_max || value > limits::pose_coordinate_max)
      refuse(std::string(what) + " is 2^30 steps or more from the origin");
    return value;
  };
  const auto width = static_cast<int>(bits(width_bits));
  QuantisedPose pose;
  pose.x = axis(width);
  pose.y = axis(width);
  pose.z = axis(width);
  if (!failed() && pending != 0) refuse(std::string(what) + " is followed by bits that are not zero");
  return pose;
}

std::span<const uint8_t> ByteReader::rest() {
  if (failed()) return {};
  CHECK(next_ <= bytes_.size());
  const std::span<const uint8_t> rest = bytes_.subspan(next_);
  next_ = bytes_.size();
  return rest;
}

void ByteReader::refuse_beyond(int64_t value, int64_t max, const char* what) {
  refuse(fmt::format("{} is {}, beyond ±{}", what, value, max));
}

void ByteReader::finish() {
  if (!failed() && next_ != bytes_.size())
    refuse(fmt::format("{} bytes left over at the end", bytes_.size() - next_));
}

}  // namespace scree
