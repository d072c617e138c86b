// Splits a byte stream into messages: u32 length (little-endian), then so many bytes.
//
// An oversized length is refused as soon as its four bytes are there, so that never more than one message
// waits in memory, plus what was pushed at once. After a refusal the stream is of no use any more.
// Not thread-safe.
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

  /// Takes over received bytes. Call next() until it has nothing before pushing more.
  void push(std::span<const uint8_t> bytes);

  /// The next whole message without its length; nothing when more bytes are needed. The span holds until the
  /// next push.
  Result<std::optional<std::span<const uint8_t>>> next();

  /// Pushed, but not yet handed out.
  size_t buffered_bytes() const { return buffer_.size() - start_; }

 private:
  size_t message_bytes_max_;
  std::vector<uint8_t> buffer_;
  size_t start_ = 0;  ///< of what was not handed out yet
};

}  // namespace scree
