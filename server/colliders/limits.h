// Bounds of how bodies find the terrain. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>

namespace scree::limits {

/// Width of the layer beyond a body's bounds that its probe copies, too, voxels: the body may move that far
/// before the probe copies again.
inline constexpr int probe_slack_voxels = 2;

/// Codes within the bounds of a body's points above which its probe copies only bricks in which points lie
/// (point_bricks.h): a copy of all would take 50 us and more. It then keeps so many bricks, 2 MB; above, all
/// are dropped, and those that are needed are copied again.
inline constexpr size_t probe_window_voxels_max = size_t{48} * 48 * 48;
inline constexpr size_t point_bricks_max = 4096;

/// Height above the highest ground from which on the ground holds only air, voxels: the generator carries
/// distances 7 voxels far from where the ground's surface may lie (shared/field/redistance.h).
inline constexpr int above_ground_voxels = 9;

/// Depth behind a triangle at which the mesh collider still finds it, voxels: a mesh has no inside. A deeper
/// point falls.
inline constexpr float mesh_depth_voxels = 1.5F;

/// Blocks of 16³ voxels whose triangles the mesh collider keeps: about 25 KB each. Above: all are dropped,
/// and made again on demand.
inline constexpr unsigned mesh_blocks_max = 1024;

/// Number of rays of the rays collider along each side of a body's footprint.
inline constexpr int rays_side = 4;

}  // namespace scree::limits
