// Bounds of how bodies find the terrain. Each says its unit, its reason, and its effect at the limit.
#pragma once

namespace scree::limits {

/// Width of the layer beyond a body's bounds that its probe copies, too, voxels: the body may move that far
/// before the probe copies again.
inline constexpr int probe_slack_voxels = 2;

/// Depth behind a triangle at which the mesh collider still finds it, voxels: a mesh has no inside. A deeper
/// point falls.
inline constexpr float mesh_depth_voxels = 1.5F;

/// Blocks of 16³ voxels whose triangles the mesh collider keeps: about 25 KB each. Above: all are dropped,
/// and made again on demand.
inline constexpr unsigned mesh_blocks_max = 1024;

/// Number of rays of the rays collider along each side of a body's footprint.
inline constexpr int rays_side = 4;

}  // namespace scree::limits
