// Bounds of the programs. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Ticks that a late simulation catches up with. Above: the ticks are lost, and counted as overruns.
inline constexpr int catch_up_ticks_max = 5;

/// Radius around each client's eye within which terrain is generated before anything touches it, chunks: 32 m
/// at voxels of 0.25 m, the reach of a viewer's tools. Beyond: the first touch generates it, inside its tick.
inline constexpr int ahead_chunks = 4;

/// Chunks that a tick tests for being generated: a few microseconds.
inline constexpr size_t ahead_looks_per_tick = 64;

}  // namespace scree::limits
