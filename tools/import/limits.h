// Bounds of imports. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Samples along a side of a raster that is imported: a row of it is kept several times. Above: refused.
inline constexpr int raster_side_max = 1 << 17;

/// A height in a raster, metres, after its scale: twice the deepest sea. What is more is no height in metres.
/// Above: refused.
inline constexpr double raster_height_max_m = 25'000.0;

/// Height between the lowest and the highest sample up to which the lowest lies at y = 0, metres; a higher
/// model's middle does.
inline constexpr double relief_at_zero_max_m = 448.0;

/// Stored chunks of one import: they lie in memory, 12 KiB each as a rule. Above: refused.
inline constexpr size_t import_chunks_max = size_t{1} << 17;

/// Chunks that a solid's surface touches; of a mesh, each counted once for each triangle that does. Above:
/// refused.
inline constexpr size_t solid_surface_max = size_t{1} << 22;

/// Meshes in one file. Above: refused.
inline constexpr size_t import_meshes_max = 4096;

/// Pixels along a side of a preview.
inline constexpr int preview_side_max = 1024;

}  // namespace scree::limits
