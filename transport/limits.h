// Bounds of byte streams. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Bytes that a layer (TLS, WebSocket) reads at once from the stream below. Above: the rest is read next
/// time.
inline constexpr size_t layer_read_bytes = size_t{16} << 10;

/// Bytes of a layer that wait to be sent. Above: no more is read, because what arrives may ask for answers
/// (key updates, pings), until these are gone.
inline constexpr size_t layer_unsent_bytes_max = size_t{64} << 10;

/// Payload of a WebSocket's frame that the server sends: with its header it fits in a TLS record.
inline constexpr size_t websocket_chunk_bytes = (size_t{16} << 10) - 16;

/// Frames of a WebSocket that carry nothing (pings, pongs, empty ones), a second and at once after a silence;
/// what they cost is in no session's count of bytes. Above: the connection ends.
inline constexpr double bare_frames_per_second_max = 20.0;
inline constexpr double bare_frames_burst_max = 100.0;

/// A simulated link: the bytes that are delayed together, and the default length of the bottleneck's queue,
/// in seconds of its rate, with its bounds. Above: nothing more is taken.
inline constexpr size_t link_packet_bytes = 1200;
inline constexpr double link_buffer_s = 0.1;
inline constexpr double link_buffer_min_bytes = 2e3;
inline constexpr double link_buffer_max_bytes = 1e6;

/// Bytes under way in one direction, so that a link without a rate has a bound of memory, too.
inline constexpr size_t link_flight_max_bytes = size_t{4} << 20;

/// What may be said of a simulated link; beyond: refused by name.
inline constexpr double link_delay_max_s = 10.0;
inline constexpr double link_rate_min_bytes_per_s = 125.0;
inline constexpr double link_rate_max_bytes_per_s = 1.25e9;
inline constexpr double link_bytes_max = 1e12;

/// Buffers that one write to a socket gathers. Above: the rest is taken next time.
inline constexpr size_t gathered_buffers_max = 16;

}  // namespace scree::limits
