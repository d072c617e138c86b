// Bounds of the flight recorder. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Ticks that are kept: ten minutes at 60 Hz, 280 bytes each, 10.1 MB. Above: the oldest go.
inline constexpr size_t flight_ticks_max = 36'000;

/// Causes of work that are kept, of all ticks together, 56 bytes each, 3.7 MB: a busy tick has some ten.
/// Above: the oldest go.
inline constexpr size_t flight_causes_max = size_t{1} << 16;

/// Causes of one tick that are kept, the dearest.
inline constexpr size_t flight_causes_a_tick_max = 16;

/// Parties whose work is counted. Above: those that did least go.
inline constexpr size_t flight_parties_max = 1024;

/// Names of sessions that are remembered after they left. Above: the oldest go.
inline constexpr size_t flight_names_max = 2048;

/// Seconds over which work by party is averaged, by an exponential decay.
inline constexpr double flight_average_s = 10.0;

/// Ticks between two looks at whose pieces are alive.
inline constexpr uint64_t flight_piece_ticks = 16;

/// Edge of the boxes, metres, by which the place is found where pieces lie closest.
inline constexpr float flight_crowd_m = 4.0F;

/// Pieces alive from which on slow bodies are a crowd's, and not a stage's.
inline constexpr uint32_t flight_crowd_pieces = 16;

/// Pages read back from the swap in a tick from which on a process that does not run was swapped out.
inline constexpr uint32_t flight_swap_pages = 16;

/// Share of its time on the network thread's own from which on it is busy, and not starved.
inline constexpr float flight_busy_share = 0.5F;

/// Milliseconds by which a tick is late before it counts as slow (--slow-ms), and that a save may take.
inline constexpr double slow_ms_default = 50.0;
inline constexpr double slow_save_ms_default = 1000.0;
inline constexpr double slow_ms_min = 1.0, slow_ms_max = 60'000.0;

/// Lines of the log of slow ticks (--slow-log) a minute, and at once. Above: they are left out, and counted.
inline constexpr double slow_lines_per_minute = 10.0;
inline constexpr double slow_lines_burst = 10.0;

/// Seconds between two slow ticks of the same cause that are told as one.
inline constexpr double slow_together_s = 1.0;

}  // namespace scree::limits
