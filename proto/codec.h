// Messages to bytes and back. proto/scree.proto is the specification.
//
// Encoders trust their input: senders keep within shared/base/limits.h and proto/limits.h. Decoders trust
// nothing: they check that every number is finite and in range, and every count before they allocate memory
// for it; a refusal names the field and the limit. A message of an unknown kind is an UnknownMessage, and so
// is a request with an unknown value; unknown fields are skipped. Pure functions, safe to call from any
// thread.
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

/// The bytes on the wire, with the length in front. The peer refuses a message above
/// limits::message_bytes_max; the sender must not send it. Only bricks and pieces come near that.
std::vector<uint8_t> encode(const ServerMessage& message);
std::vector<uint8_t> encode(const ClientMessage& message);

/// `body` is one whole message without its length, as FrameReader::next() returns it.
///
/// A carve or fill of any size is decoded, so that the world can refuse it with a reply; only numbers that
/// are not finite, and unknown kinds, are refused here.
Result<ServerMessage> decode_server(std::span<const uint8_t> body);
Result<ClientMessage> decode_client(std::span<const uint8_t> body);

}  // namespace scree
