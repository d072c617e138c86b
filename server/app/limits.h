// Bounds of the programs. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Ticks that a late simulation catches up with. Above: the ticks are lost, and counted as overruns.
inline constexpr int catch_up_ticks_max = 5;

/// Radius around each client's eye within which terrain is generated before anything touches it, chunks: 32 m
/// at voxels of 0.25 m, the reach of a viewer's tools. Beyond: edits wait for it.
inline constexpr int ahead_chunks = 4;

/// Chunks that a tick tests for being generated: a few microseconds.
inline constexpr size_t ahead_looks_per_tick = 64;

/// Chunks that edits wait for at once, to be generated: some two seconds' work. Above: more are asked for
/// when these have come.
inline constexpr size_t ahead_asked_max = 1024;

/// Seconds that an edit waits for its terrain to be generated. Above: its tick generates what is lacking.
inline constexpr double generated_wait_s = 0.25;

/// Chunks that a tick tests for being out of memory, around eyes: some 10 us. The radius is ahead_chunks.
inline constexpr size_t pager_looks_per_tick = 128;

/// A piece is looked at every so many ticks, where it is and where it will be so many ticks later: reading a
/// chunk takes less.
inline constexpr unsigned piece_look_ticks = 8;
inline constexpr unsigned piece_ahead_ticks = 30;

/// Places of pieces that are gone are forgotten when there are more than so many.
inline constexpr size_t pieces_forgotten_min = 1024;

/// Ticks for which nobody asked for a chunk that goes out of memory.
inline constexpr uint64_t pager_idle_ticks = 60;

/// When more bricks are in memory than there should be, one of so many goes out, at most so many chunks in a
/// tick: a fraction of a millisecond.
inline constexpr size_t pager_parts = 8;
inline constexpr size_t page_out_per_tick = 32;

/// Ticks between two counts of what is in memory.
inline constexpr unsigned pager_count_ticks = 8;

/// Seconds that an edit waits for its terrain to be read, or for room in memory. Above: it is refused.
inline constexpr double held_seconds_max = 5.0;

/// Terrain around an edit's box that must be in memory, too, voxels: what hangs loose is searched there.
inline constexpr int admitted_margin_voxels = 16;

/// Voxels of an edit's box for which anything is read; a larger one is beyond the simulation's own limits.
inline constexpr size_t admitted_voxels_max = size_t{1} << 24;

}  // namespace scree::limits
