// Bounds of a client's connection. Each says its unit, its reason, and what happens there.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Messages received that nobody has polled yet. Above: the socket is not read, and the server sees that we
/// lag.
inline constexpr size_t received_messages_max = 4096;

/// Memory of those messages, decoded, bytes. Above: the same.
inline constexpr size_t received_bytes_max = size_t{32} << 20;

/// Bytes that wait to be sent. A client sends little; above: the connection is given up.
inline constexpr size_t unsent_bytes_max = size_t{1} << 20;

/// Bytes read from the socket at once.
inline constexpr size_t read_bytes = size_t{64} << 10;

}  // namespace scree::limits
