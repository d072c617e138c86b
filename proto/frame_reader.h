// Splits a byte stream into messages: a u32 length (little-endian), then that many bytes.
//
// An oversized length is refused as soon as its four bytes are there, so that at most one message and the
// last pushed bytes are in memory. After a refusal the stream cannot be used any more. Not thread-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shared/base/limits.h"
#include "shared/base/result.h"

namespace scree {

class FrameReader {
 public:
  explicit FrameReader(size_t message_bytes_max = limits::message_bytes_max)
      : message_bytes_max_(message_bytes_max) {}

  /// Holds from the next message on that next() looks at.
  void set_message_bytes_max(size_t bytes) { message_bytes_max_ = bytes; }

  /// Appends received bytes. Call next() until it returns nothing before the next push.
  void push(std::span<const uint8_t> bytes);

  /// The next whole message without its length; nothing when more bytes are needed. The span is valid until
  /// the next push.
  Result<std::optional<std::span<const uint8_t>>> next();

  /// Bytes pushed, but not returned by next().
  size_t buffered_bytes() const { return buffer_.size() - start_; }

 private:
  size_t message_bytes_max_;
  std::vector<uint8_t> buffer_;
  size_t start_ = 0;  ///< index of the first byte not returned
};

}  // namespace scree
