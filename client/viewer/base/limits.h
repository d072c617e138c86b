// Bounds of the viewer. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

#include "client/render/scene/limits.h"

namespace scree::limits {

/// Seconds between two reports of the camera's place.
inline constexpr double report_interval_s = 0.25;

/// Least movement of the camera between two reports, metres.
inline constexpr float report_distance_m = 1.0F;

/// Seconds between two reports of the cursor, as often as a server passes it on; and how far it must have
/// moved, metres.
inline constexpr double cursor_interval_s = 0.1;
inline constexpr float cursor_distance_m = 0.05F;

/// Length of the ray by which a hand aims, metres. How far it may edit says the server.
inline constexpr float carve_reach_m = 200.0F;

/// Wait between `pieces>=N` and its screenshot, seconds, in which the pieces fly apart.
inline constexpr double flight_s = 0.5;

/// Time without any piece alive after which the terrain counts as settled, seconds.
inline constexpr double settled_s = 2.0;

/// Bytes of a path or of the settings; a larger file is refused.
inline constexpr size_t text_file_bytes_max = size_t{1} << 20;

/// Levels of lists and objects in such a file, ten times what either has; a deeper one is refused.
inline constexpr size_t json_depth_max = 32;

/// Shortest time between two key frames, seconds: half a millisecond, less than any frame takes. A shorter
/// one is refused: speeds would have no bound.
inline constexpr double path_step_min_s = 5e-4;

/// Key frames of a path, and its seconds: an hour, 108,000 pictures. More is refused.
inline constexpr size_t path_keys_max = 10000;
inline constexpr double path_duration_max_s = 3600.0;

/// Requests whose time to the answer is measured; above: the oldest is forgotten.
inline constexpr size_t own_requests_timed_max = 64;

/// Lines of chat that are kept, and seconds for which one is shown, unless the person writes one.
inline constexpr size_t lines_kept_max = 8;
inline constexpr double line_shown_s = 15.0;

/// Events of pieces in one frame, for sound and dust: a blast makes about as many pieces. Above: those of the
/// least impulse are left out.
inline constexpr size_t piece_events_per_step_max = 96;

/// Messages of a game's rules that wait for the program, which takes them in each frame. Above: the oldest
/// are dropped.
inline constexpr size_t messages_heard_max = 256;

/// Seconds that dust stays in the air: less than settled_s, so that pictures of what has settled have none.
inline constexpr float particle_seconds_max = 1.9F;

/// Frames of sound made for the file at once: five seconds. A longer pause of the program is shortened.
inline constexpr size_t sound_step_frames_max = 240000;

/// Wishes for a replay that wait to be sent. Above: more are dropped.
inline constexpr size_t replay_wishes_waiting_max = 16;

/// Seconds after which a move of a replay counts as done, whatever the server says: longer than a jump takes.
inline constexpr double replay_move_s = 2.0;

/// Seconds between two updates of the HUD's costly counts.
inline constexpr double count_interval_s = 0.5;

/// Radius of interest where the quality decides how far is drawn finely, metres; at least. Servers allow
/// edits up to 64 m away, as a rule, and who edits has to learn what became of it.
inline constexpr float interest_least_m = 80.0F;

}  // namespace scree::limits
