// Writing and reading of packed bytes; the notation is that of proto/scree.proto. Internal to proto/,
// auth/ and client/cache/.
//
// After the first error, a reader keeps its reason and returns zeros, so that expressions of several reads
// stay simple. The caller tests failed() before it uses a value, allocates memory or loops.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "proto/limits.h"
#include "shared/base/kind_table.h"
#include "shared/base/result.h"
#include "shared/field/coord.h"
#include "shared/field/piece.h"

namespace scree {

/// Maps signed to unsigned numbers and back, small to small: 0, −1, 1, −2 … become 0, 1, 2, 3 …
constexpr uint64_t fold_sign(int64_t value) {
  return (static_cast<uint64_t>(value) << 1U) ^ static_cast<uint64_t>(value >> 63);
}
constexpr int64_t unfold_sign(uint64_t folded) {
  return static_cast<int64_t>((folded >> 1U) ^ (0ULL - (folded & 1U)));
}

class ByteWriter {
 public:
  explicit ByteWriter(std::vector<uint8_t>& bytes) : bytes_(bytes) {}

  void u8(uint8_t value) { bytes_.push_back(value); }
  void u32(uint32_t value);
  void u64(uint64_t value);
  void varint(uint64_t value);
  void zigzag(int64_t value);
  void f32(float value);
  void vec3(glm::vec3 value);
  /// Three equally wide numbers after their width, in bits (scree.proto, "position").
  void position(const QuantisedPose& pose);

 private:
  std::vector<uint8_t>& bytes_;
};

class ByteReader {
 public:
  /// `subject` is the first word of every refusal. `bytes` and `subject` must outlive the reader.
  ByteReader(std::span<const uint8_t> bytes, const char* subject) : bytes_(bytes), subject_(subject) {}

  uint64_t varint(const char* what, uint64_t max = std::numeric_limits<uint64_t>::max());
  /// A number within ± max.
  int64_t zigzag(const char* what, int64_t max);
  uint8_t u8(const char* what, uint8_t max);
  /// A byte that is the number of a known kind.
  template <HasRows Kind>
  Kind kind(const char* what) {
    return static_cast<Kind>(u8(what, static_cast<uint8_t>(kind_count<Kind> - 1)));
  }
  uint32_t u32(const char* what);
  uint64_t u64(const char* what);
  float f32(const char* what);
  glm::vec3 vec3(const char* what);
  /// x, y and z of a pose.
  QuantisedPose position(const char* what);
  /// As many bytes.
  std::span<const uint8_t> read_bytes(size_t count, const char* what);
  /// All remaining bytes.
  std::span<const uint8_t> rest();

  bool at_end() const { return failed() || next_ == bytes_.size(); }
  bool failed() const { return !error_.message.empty(); }
  /// Keeps the reason, unless there is an earlier one.
  void refuse(const std::string& reason);
  /// A number that is not within ± max.
  void refuse_beyond(int64_t value, int64_t max, const char* what);
  /// Refuses remaining bytes.
  void finish();
  const Error& error() const { return error_; }

 private:
  bool advance(size_t count, const char* what);

  std::span<const uint8_t> bytes_;
  const char* subject_;
  size_t next_ = 0;
  Error error_;
};

/// Writes coordinates, each as its difference to the one before.
template <typename Tag>
void write_coords(ByteWriter& writer, std::span<const Coord<Tag>> coords) {
  Coord<Tag> before;
  for (const Coord<Tag>& c : coords) {
    writer.zigzag(int64_t{c.x} - before.x);
    writer.zigzag(int64_t{c.y} - before.y);
    writer.zigzag(int64_t{c.z} - before.z);
    before = c;
  }
}

/// Reads the coordinate after `before`; each number is within ± max.
template <typename Tag>
Coord<Tag> read_coord(ByteReader& reader, const Coord<Tag>& before, int32_t max, const char* what) {
  const auto axis = [&](int32_t from) {
    const int64_t value = from + reader.zigzag(what, int64_t{2} * max);
    if (value < -max || value > max) reader.refuse_beyond(value, max, what);
    return static_cast<int32_t>(value);
  };
  const int32_t x = axis(before.x);
  const int32_t y = axis(before.y);
  return {x, y, axis(before.z)};
}

}  // namespace scree
