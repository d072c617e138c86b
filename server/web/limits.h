// Bounds of HTTP. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Bytes of a request's head, its line and all fields. Browsers send a tenth of it. Above: 431, and closed.
inline constexpr size_t http_head_bytes_max = size_t{8} << 10;

/// Seconds from the first byte of a head to its end. Above: closed.
inline constexpr double http_head_seconds_max = 5.0;

/// Seconds that a connection may stay open between requests. Above: closed; browsers open another one.
inline constexpr double http_idle_seconds_max = 15.0;

/// Bytes of a file that are handed to a connection at once. Above: the rest follows.
inline constexpr size_t http_write_bytes_max = size_t{256} << 10;

/// Digits by which a page names its attempt to open a WebSocket, and those of a pass: 128 bits.
inline constexpr size_t socket_digits = 32;

/// Attempts that failed and are remembered, so that their pages can ask why. Above: the oldest is forgotten.
inline constexpr size_t socket_attempts_max = 256;

/// Bytes of a name of a host (RFC 1035, 2.3.4). Above: no name, and in words cut.
inline constexpr size_t host_bytes_max = 255;

/// Bytes of a page's origin in words: a scheme, the longest name of a host, and a port. Above: cut.
inline constexpr size_t origin_bytes_max = 272;

/// Files of the page, their bytes in memory with the compressed ones, and folders in folders. Above: the
/// server does not start, and says which folder it is.
inline constexpr size_t web_files_max = 512;
inline constexpr size_t web_bytes_max = size_t{64} << 20;
inline constexpr int web_folders_max = 4;

}  // namespace scree::limits
