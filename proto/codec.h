// Messages to bytes and back. proto/scree.proto is the specification.
//
// What is written is trusted: senders keep within shared/base/limits.h and proto/limits.h. What is read is
// not: every number is checked for being finite and in range, every count before memory is allocated for it,
// and a refusal names the field and the limit. Pure functions, safe to call from any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "proto/limits.h"
#include "proto/messages.h"
#include "shared/base/result.h"

namespace scree {

/// Bytes of the length in front of every message: u32, little-endian, without itself.
inline constexpr size_t length_prefix_bytes = 4;

/// The message as it crosses the wire, length in front. Above limits::message_bytes_max the peer refuses it:
/// whoever builds frames splits them (only bricks ever come near).
std::vector<uint8_t> encode(const ServerMessage& message);
std::vector<uint8_t> encode(const ClientMessage& message);

/// `body` is one whole message without its length, as FrameReader hands it out.
///
/// A carve or fill is decoded whatever its size, so that the world can answer it with a reply; only what is
/// no number or no known kind is refused here.
Result<ServerMessage> decode_server(std::span<const uint8_t> body);
Result<ClientMessage> decode_client(std::span<const uint8_t> body);

}  // namespace scree
