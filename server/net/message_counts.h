// How many messages of each kind went to clients and came from them, and their bytes with the length in
// front. A value.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "proto/codec.h"
#include "proto/message_kind.h"

namespace scree {

struct MessageCount {
  uint64_t messages = 0;
  uint64_t bytes = 0;

  void add(size_t more_bytes) {
    ++messages;
    bytes += more_bytes;
  }
};

struct MessageCounts {
  std::array<MessageCount, server_message_kinds.size()> out;
  std::array<MessageCount, client_message_kinds.size()> in;

  /// `bytes`: with the length in front.
  void add_out(std::span<const uint8_t> bytes) {
    out[message_kind(bytes.subspan(length_prefix_bytes), server_message_kinds)].add(bytes.size());
  }
  void add_in(std::span<const uint8_t> body) {
    in[message_kind(body, client_message_kinds)].add(length_prefix_bytes + body.size());
  }
};

}  // namespace scree
