// Bounds of a bot. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Requests that wait for their replies. Above: the bot sends no more until some are answered.
inline constexpr size_t bot_requests_waiting_max = 64;

/// Milliseconds to wait before the n-th try to connect again, times n.
inline constexpr int bot_retry_ms = 250;

/// Milliseconds that one try to connect may take.
inline constexpr int bot_connect_ms = 5000;

/// Statuses (one a second) without an equal hash, after everything is done, until the bot gives up on it.
inline constexpr uint32_t bot_final_statuses_max = 10;

/// Distance before the eye of who begins in a world at which a bot carves, metres, where nobody says a place:
/// in the middle of that picture.
inline constexpr float bot_ahead_m = 22.0F;

/// Length of the ray by which a bot finds a surface to carve, metres.
inline constexpr float bot_sight_m = 96.0F;

/// Distance of a blow from the bot's eye above which it goes there first, metres: less than the reach that
/// servers allow by default (ServiceLimits::reach_m). A server that allows less has its own distance.
inline constexpr float bot_reach_m = 48.0F;

/// Seconds by which a bot's walk may be behind the clock, because its process stood still. Above: it goes on
/// from now.
inline constexpr double bot_walk_behind_s = 0.25;

/// Distance that a bot on foot goes before it says where it is, metres.
inline constexpr float bot_follow_m = 4.0F;

/// Part of a server's reach within which a bot on foot edits: it cannot go nearer first, and it walks on
/// until the request is carried out.
inline constexpr float bot_foot_reach_part = 0.8F;

/// Metres between a bot's own body and the ball of rubble that it puts down: less would be in its way.
inline constexpr float bot_place_apart_m = 1.5F;

/// Looks for a place that is far enough from the own body. Above: the server may refuse it.
inline constexpr int bot_looks_max = 16;

/// Radius of a ball of rubble that a bot puts down, metres: a voxel of the usual size. Smaller ones would be
/// empty.
inline constexpr float bot_place_min_m = 0.25F;

/// Messages of a game's rules that a report has, and lines. Above: they are counted alone.
inline constexpr size_t bot_heard_max = 256;

/// Bytes of such a message that the log has. Above: it is cut.
inline constexpr size_t bot_heard_shown_bytes = 200;

/// Letters by which the name of a material may differ from the one that is proposed. Above: none is.
inline constexpr size_t bot_mistyped_max = 2;

}  // namespace scree::limits
