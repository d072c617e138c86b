// Bounds of the grid that the method grid draws by.
#pragma once

namespace scree::limits {

/// Cells along a side, in steps so that both halves are whole blocks. Software takes more than seconds to
/// draw the most, 16.8 million points.
inline constexpr int grid_resolution_min = 32;
inline constexpr int grid_resolution_max = 256;
inline constexpr int grid_resolution_step = 16;

/// Voxels between the grid's points about the eye, a power of two: cells lie within bricks then. The most, 2
/// m at voxels of 25 cm, is rough already.
inline constexpr int grid_scale_max = 8;

}  // namespace scree::limits
