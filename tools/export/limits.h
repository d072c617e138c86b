// Bounds of exports. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <chrono>
#include <cstddef>

namespace scree::limits {

/// Triangles of one mesh: their points have 32-bit numbers, and all of it lies in memory, 4 GiB. Above:
/// refused.
inline constexpr size_t export_triangles_max = size_t{1} << 26;

/// Voxels of rock in one MagicaVoxel file, 1.5 GiB of memory. Above: refused.
inline constexpr size_t export_voxels_max = size_t{1} << 26;

/// Chunks of one export: an hour or so. Above: refused.
inline constexpr size_t export_chunks_max = size_t{1} << 22;

/// Edited bricks of a kept world in memory, 170 MB. Above: those that were read first are let go, and read
/// again when they are asked for.
inline constexpr size_t export_bricks_max = size_t{1} << 18;

/// Time that a server may take to welcome a session, milliseconds. Above: it counts as not there.
inline constexpr std::chrono::milliseconds export_connect_ms{10'000};

}  // namespace scree::limits
