// What operations cost by the model of work: microseconds as measured on one core of a 2023 server (bench
// model). Server and client go by the same.
#pragma once

namespace scree::limits {

/// An edit, and a voxel of its box; a chunk in it that no edit has touched: as a rule its terrain was
/// generated before (server/app/terrain_ahead.h); where it was not, that takes seven times as long.
inline constexpr float edit_cost_us = 150.0F;
inline constexpr float edit_voxel_cost_us = 0.015F;
inline constexpr float chunk_cost_us = 40.0F;

/// A voxel of a piece's window in a merge, whose other cost is the method's
/// (shared/recombine/stamp_method.h): with the largest pieces, of 60,000 voxels, that is nearly all. A cut
/// costs as its cutter says (shared/fracture/cutter.h).
inline constexpr float stamp_voxel_cost_us = 0.05F;

/// An island that is lifted, and a voxel of its box, both with hull, surface points and convex parts.
inline constexpr float lift_cost_us = 400.0F;
inline constexpr float lift_voxel_cost_us = 0.09F;

/// A slide of rubble, and a voxel of its window.
inline constexpr float slide_cost_us = 660.0F;
inline constexpr float slide_voxel_cost_us = 0.0042F;

/// Parts into which what a shape leaves of a piece falls apart. Above: the smaller ones become dust.
inline constexpr unsigned cut_rests_max = 8;

/// Sides of a slide's box along x and z, along y, and of a cell, voxels; and the tangent of its angle, in
/// 64ths: up to 63°. Above: refused.
inline constexpr int slide_side_max_voxels = 80;
inline constexpr int slide_height_max_voxels = 128;
inline constexpr int slide_cell_max_voxels = 8;
inline constexpr int slide_tangent_max = 127;

/// A brick that becomes what it was once.
inline constexpr float restored_brick_cost_us = 12.0F;

/// Bricks, and pieces, of one restore: half a chunk, less than 40 KiB when nothing compresses. Above:
/// refused.
inline constexpr unsigned restored_bricks_max = 32;
inline constexpr unsigned restored_pieces_max = 64;
/// Chunks of one request in which terrain may hang loose after a restore. Above: refused.
inline constexpr unsigned loose_chunks_max = 64;

}  // namespace scree::limits
