// What operations cost by the model of work: microseconds as measured on one core of a 2023 server (benches
// storm and worst). Server and client go by the same.
#pragma once

namespace scree::limits {

/// An edit, and a voxel of its box; a chunk in it whose terrain may have to be generated.
inline constexpr float edit_cost_us = 400.0F;
inline constexpr float edit_voxel_cost_us = 0.05F;
inline constexpr float chunk_cost_us = 300.0F;

/// A volume that is cut into pieces by the cutter `field`, a voxel of its window, and a piece with its hull
/// and body.
inline constexpr float cut_cost_us = 100.0F;
inline constexpr float cut_voxel_cost_us = 0.07F;
inline constexpr float piece_cost_us = 25.0F;

/// The same for the cutters of polygons.
inline constexpr float polygons_cost_us = 6000.0F;
inline constexpr float polygons_voxel_cost_us = 0.9F;
inline constexpr float polygons_piece_cost_us = 350.0F;

/// A merge, by method, and a voxel of the piece's window: with the largest pieces, of 60,000 voxels, that is
/// nearly all.
inline constexpr float stamp_cost_us = 55.0F;
inline constexpr float slices_cost_us = 60.0F;
inline constexpr float sphere_cost_us = 170.0F;
inline constexpr float stamp_voxel_cost_us = 0.02F;

/// An island that is lifted, and a voxel of its box, both with hull, surface points and convex parts.
inline constexpr float lift_cost_us = 400.0F;
inline constexpr float lift_voxel_cost_us = 0.09F;

}  // namespace scree::limits
