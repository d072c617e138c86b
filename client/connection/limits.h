// Bounds of a client's connection. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Received messages that wait for poll(). Above: the socket is not read, and the server sees that this
/// client lags.
inline constexpr size_t received_messages_max = 4096;

/// Memory of those messages, decoded, bytes. Above: the same.
inline constexpr size_t received_bytes_max = size_t{32} << 20;

/// Bytes that wait to be sent; a client sends few. Above: the connection is closed.
inline constexpr size_t unsent_bytes_max = size_t{1} << 20;

/// Seconds without a byte from a server that has sent frames. It sends one twice a second at least, so above
/// the connection counts as lost: a machine that went away, or a router that forgot it, tells nobody.
inline constexpr double silent_seconds_max = 10.0;

/// Milliseconds that a goodbye may take to be handed to the socket. Above: the connection is closed without.
inline constexpr int goodbye_ms_max = 250;

/// Bytes read from the socket at once.
inline constexpr size_t read_bytes = size_t{64} << 10;

/// Bytes of the kernel's receive buffer of a connection by a simulated link; Linux gives twice as many. They
/// wait beside those at the link's bottleneck, so they are few. Above: the server's kernel holds them back.
inline constexpr int link_receive_bytes = 2048;

}  // namespace scree::limits
