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
inline constexpr size_t cache_entry_bytes = 128;

/// Chunks that are packed in one call while a session lasts: a frame is not to notice.
inline constexpr size_t chunks_packed_at_once = 2;

/// Chunks that are packed when a connection ends: a second or two, were all of their bricks edited. The
/// others are sent again.
inline constexpr size_t chunks_packed_at_end = 8192;

/// Seconds between two times that a lasting session's chunks are packed, and written: what a crash may lose.
inline constexpr double cache_interval_s = 120.0;

/// Seconds after which a file that was never finished is removed.
inline constexpr double unfinished_seconds_max = 3600.0;

/// Bytes of a server's name in a file's.
inline constexpr size_t cache_name_bytes_max = 100;

/// Tiles of the ground that are asked for at once: enough for a link of 2 MB/s and 0.2 s, and less than a
/// server lets wait. Above: the others later.
inline constexpr size_t tiles_asked_max = 32;

/// Tiles that somebody has missed and that have not come; each is missed again as long as it is needed.
/// Above: the others later.
inline constexpr size_t tiles_missed_max = 4096;

/// Bytes of the ground's tiles in memory. Above: no more are asked for, and what is farther is drawn
/// coarsely.
inline constexpr size_t tile_memory_max = size_t{384} << 20;

/// Tiles that are read from files in one call: a frame is hardly to notice. The others the next time.
inline constexpr size_t tiles_read_at_once = 32;

/// Tiles received between two times that the files are bounded.
inline constexpr uint64_t tiles_between_bounds = 64;

/// Palettes and images that are asked for at once, and their bytes in memory: all images of one palette, and
/// a few palettes. Above: what comes is as if the server had none.
inline constexpr size_t contents_asked_max = 8;
inline constexpr size_t content_memory_max = size_t{65} << 20;

/// Models of props that are wanted in one session, twice as many as a server has, and their files' bytes in
/// memory. Above: the parts of props are drawn.
inline constexpr size_t models_wanted_max = 512;
inline constexpr size_t model_files_memory_max = size_t{65} << 20;

/// Metres beyond the radius of interest up to which chunks are offered, for who moves.
inline constexpr float offer_margin_m = 8.0F;

/// Milliseconds that a session's attempt to reach its server may take. Above: it failed, and the next one
/// begins later.
inline constexpr int connect_ms_max = 3000;

}  // namespace scree::limits
