// Bounds of what a client keeps. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// MiB kept of all worlds together, unless told otherwise, and at most: a world with 10,000 carves takes
/// about
/// 10. Above: the chunks used longest ago go first, and of the files the ones written longest ago.
inline constexpr size_t cache_mib_default = 128;
inline constexpr size_t cache_mib_max = 16384;

/// Bytes that a kept chunk takes beside its packed bricks.
inline constexpr size_t kept_chunk_bytes = 128;

/// Chunks that are packed in one call while a session lasts: a frame is not to notice.
inline constexpr size_t chunks_packed_at_once = 2;

/// Chunks that are packed when a connection ends: a second or two, were all of their bricks edited. The
/// others are sent again.
inline constexpr size_t chunks_packed_at_end = 8192;

/// Seconds between two times that a lasting session's chunks are packed, and written: what a crash may lose.
inline constexpr double keep_interval_s = 120.0;

/// Seconds after which a file that was never finished is removed.
inline constexpr double unfinished_seconds_max = 3600.0;

/// Bytes of a server's name in a file's.
inline constexpr size_t cache_name_bytes_max = 100;

/// Metres beyond the radius of interest up to which chunks are offered, for who moves.
inline constexpr float offer_margin_m = 8.0F;

}  // namespace scree::limits
