// Limits of the bus, each with its unit and reason.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Between attempts to connect, ms: a server of NATS that is started again is found soon.
inline constexpr int64_t bus_retry_ms = 250;

/// Between pings of the connection, ms, and how many may stay without an answer: a cut link is known after
/// their product.
inline constexpr int64_t bus_ping_ms = 1500;
inline constexpr int bus_pings_out_max = 2;

/// For an answer of the bus, ms. Above: an error, and the caller tries again later.
inline constexpr int64_t bus_answer_ms = 2000;

/// Messages on their way into a stream, not yet confirmed. Above: the sending thread waits.
inline constexpr int64_t bus_unconfirmed_max = 256;

/// Messages, and bytes, that wait in this process for the handler of a subscription. Above: the newest are
/// lost, which the readers of streams notice.
inline constexpr int bus_waiting_messages_max = 16384;
inline constexpr int bus_waiting_bytes_max = 64 << 20;

/// Characters of the name of a world or of an edge: it is a part of subjects and names of streams.
inline constexpr size_t bus_name_bytes_max = 48;

}  // namespace scree::limits
