// Bounds of a client's session. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Seconds until the next attempt to reach a server that is gone. After so many first ones that led to
/// nothing, as long as a server takes to start anew, twice as many each time; at most the third number. A
/// connection that lasted for the fourth one was worth something.
inline constexpr double reconnect_min_s = 1.0;
inline constexpr uint32_t reconnect_first = 15;
inline constexpr double reconnect_max_s = 60.0;
inline constexpr double reconnect_worth_s = 10.0;

/// Seconds between two acknowledgements of frames: the server only counts them. None is sent while no newer
/// frame has come.
inline constexpr double acknowledge_interval_s = 0.25;

/// Time without a new chunk after which the edits within the interest count as loaded, seconds.
inline constexpr double loaded_quiet_s = 0.5;

/// Delay of drawn pieces behind the server, seconds: two intervals of transforms, so that late frames still
/// arrive in time (anchors: 85 ms are needed under 2 to 5 % loss at 60 Hz).
inline constexpr double playback_delay_s = 0.1;

/// Seconds for which the playback clock runs on without a frame, because a server sends none while nothing
/// happens. Above: the link has a gap, and what is shown waits.
inline constexpr double playback_quiet_s = 0.6;

/// Part of a later frame's delay that the playback clock takes over: follows drift within seconds, ignores
/// jitter.
inline constexpr double playback_drift = 0.01;

/// Difference between a frame and the playback clock at which the clock restarts, seconds.
inline constexpr double playback_jump_s = 1.0;

/// Seconds of a person's inputs that the server has not taken yet. Above: the person stands still, for a link
/// that holds up so much has a gap.
inline constexpr double walk_untaken_max_s = 2.0;

/// Delayed messages. Above: all are applied at once.
inline constexpr size_t playback_messages_max = 4096;

}  // namespace scree::limits
