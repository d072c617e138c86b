#include "proto/frame_reader.h"

#include <fmt/format.h>

#include "proto/codec.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// The first four bytes of a PROXY header, version 1 ("PROX") or 2, as a length.
bool begins_proxy_header(size_t length) {
  return length == 0x584f5250 || length == 0x0a0d0a0d;
}

}  // namespace

void FrameReader::push(std::span<const uint8_t> bytes) {
  CHECK(start_ <= buffer_.size());
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<ptrdiff_t>(start_));
  start_ = 0;
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

Result<std::optional<std::span<const uint8_t>>> FrameReader::next() {
  if (buffered_bytes() < length_prefix_bytes) return std::nullopt;
  size_t length = 0;
  for (size_t i = 0; i < length_prefix_bytes; ++i) length |= size_t{buffer_[start_ + i]} << (8 * i);
  if (length > message_bytes_max_ && begins_proxy_header(length))
    return fail("this is a PROXY header: the server trusts no proxy at this address (--proxy)");
  if (length > message_bytes_max_)
    return fail(
        fmt::format("a message of {} bytes was announced, over the limit of {}", length, message_bytes_max_));
  if (buffered_bytes() < length_prefix_bytes + length) return std::nullopt;
  const std::span<const uint8_t> body(buffer_.data() + start_ + length_prefix_bytes, length);
  start_ += length_prefix_bytes + length;
  return body;
}

}  // namespace scree
