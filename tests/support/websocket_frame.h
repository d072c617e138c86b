// Frames of a WebSocket as a client sends them, or should not.
#pragma once

#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

namespace scree {

/// The first bytes of a frame, as a client sends it but for what is asked otherwise.
struct FrameShape {
  uint8_t opcode = 2;  ///< binary
  bool fin = true;
  bool masked = true;
  uint8_t reserved = 0;
  std::optional<uint64_t> says_bytes{};  ///< instead of the payload's length
};

inline std::vector<uint8_t> websocket_frame(std::span<const uint8_t> payload, const FrameShape& shape = {}) {
  const uint64_t length = shape.says_bytes.value_or(payload.size());
  std::vector<uint8_t> frame = {
      static_cast<uint8_t>((shape.fin ? 0x80U : 0U) | (shape.reserved << 4U) | shape.opcode)};
  const uint8_t mask_bit = shape.masked ? 0x80 : 0;
  const int length_bytes = length < 126 ? 0 : length < 65536 ? 2 : 8;
  frame.push_back(mask_bit | static_cast<uint8_t>(length_bytes == 0   ? length
                                                  : length_bytes == 2 ? 126
                                                                      : 127));
  for (int i = length_bytes - 1; i >= 0; --i) frame.push_back(static_cast<uint8_t>(length >> (8 * i)));
  constexpr uint8_t mask[4] = {0x12, 0x34, 0x56, 0x78};
  if (shape.masked) frame.insert(frame.end(), std::begin(mask), std::end(mask));
  for (size_t i = 0; i < payload.size(); ++i)
    frame.push_back(shape.masked ? payload[i] ^ mask[i % 4] : payload[i]);
  return frame;
}

}  // namespace scree
