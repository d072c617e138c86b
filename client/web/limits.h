// Bounds of the client in a browser. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Seconds of a frame in which messages are applied; one is applied as a whole. Above: what is due waits for
/// the next frame. With the next, a quarter of the 50 ms after which a browser calls a task long.
inline constexpr double page_apply_s = 0.008;

/// Seconds of a frame in which received bytes become messages. Above: the same.
inline constexpr double page_decode_s = 0.004;

/// Seconds in which terrain and pieces are generated and meshed, between two frames or more often; a job runs
/// as a whole.
inline constexpr double page_work_s = 0.008;

/// The same while the world within view is not drawn yet: nothing moves smoothly then, and it is there the
/// sooner.
inline constexpr double page_load_s = 0.024;

/// Seconds that an attempt to join may take, the browser's handshakes among them. Above: it failed.
inline constexpr double page_join_s = 10.0;

/// Bytes that have come and are not taken yet: a browser lets nobody stop reading. Above: the connection is
/// closed, and the next one gets the newest state.
inline constexpr size_t page_unread_bytes_max = size_t{48} << 20;

/// Bytes of one binary message; a server sends at most some messages of its own at once. Above: the
/// connection is closed.
inline constexpr size_t page_message_bytes_max = size_t{32} << 20;

/// Bytes of edited chunks that are kept for the next connection of the same page: 10,000 carves take 8.
inline constexpr size_t page_cache_bytes = size_t{16} << 20;

/// Frames whose times the figures are of: two seconds at 60 a second.
inline constexpr size_t page_frames_max = 120;

/// Longest frame that moves the camera, seconds: a page that was hidden does not jump.
inline constexpr float page_elapsed_max_s = 0.5F;

}  // namespace scree::limits
