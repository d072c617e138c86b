// Cuts a value into the parts that a bus carries, and puts parts together again. Not thread-safe.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "server/formats/bus_codec.h"

namespace scree {

/// Bytes of a part where a message may have so many.
inline size_t told_part_bytes(size_t payload_max) {
  constexpr size_t envelope_bytes = 256;
  return std::clamp<size_t>(payload_max - std::min(payload_max, envelope_bytes), 1024,
                            limits::told_part_bytes_max);
}

inline uint32_t told_parts_of(size_t bytes, size_t part_bytes) {
  return static_cast<uint32_t>(std::max<size_t>(1, (bytes + part_bytes - 1) / part_bytes));
}

inline ToldPart told_part(uint64_t run, Tick tick, std::span<const uint8_t> bytes, size_t part_bytes,
                          uint32_t number) {
  const size_t from = std::min(bytes.size(), number * part_bytes);
  const auto part = bytes.subspan(from, std::min(part_bytes, bytes.size() - from));
  return {run, tick, number, told_parts_of(bytes.size(), part_bytes), {part.begin(), part.end()}};
}

/// Takes the parts of one value after the other, each in order. A part that does not follow the last one
/// drops what is there.
class ToldAssembly {
 public:
  explicit ToldAssembly(size_t bytes_max) : bytes_max_(bytes_max) {}

  struct Value {
    uint64_t run = 0;
    Tick tick = 0;
    std::vector<uint8_t> bytes;
  };
  /// The value that this part completes.
  std::optional<Value> add(ToldPart part) {
    const bool follows =
        part.number == next_ && part.run == value_.run && part.tick == value_.tick && part.count == count_;
    if (part.number != 0 && !follows) {
      reset();
      return std::nullopt;
    }
    if (part.number == 0) {
      value_ = {part.run, part.tick, {}};
      count_ = part.count;
    }
    if (value_.bytes.size() + part.bytes.size() > bytes_max_) {
      reset();
      return std::nullopt;
    }
    value_.bytes.insert(value_.bytes.end(), part.bytes.begin(), part.bytes.end());
    next_ = part.number + 1;
    if (next_ < count_) return std::nullopt;
    Value whole = std::exchange(value_, {});
    reset();
    return whole;
  }
  void reset() {
    value_ = {};
    next_ = count_ = 0;
  }

 private:
  const size_t bytes_max_;
  Value value_;
  uint32_t next_ = 0;  ///< number of the part that follows
  uint32_t count_ = 0;
};

}  // namespace scree
