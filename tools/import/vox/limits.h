// Bounds of MagicaVoxel files. Each says its unit, its reason, and its effect at the limit.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::limits {

/// Bytes of a file: a million nodes, or a hundred million voxels. Above: refused.
inline constexpr uint64_t vox_file_bytes_max = uint64_t{1} << 29;

/// Voxels along a side of a model: a voxel's place has a byte for each axis. Above: refused.
inline constexpr int vox_side_max = 256;

/// Models of a file. Above: refused.
inline constexpr size_t vox_models_max = size_t{1} << 16;

/// Nodes of a file's scene, and levels of groups in groups. Above: refused.
inline constexpr size_t vox_nodes_max = size_t{1} << 18;
inline constexpr int vox_depth_max = 64;

/// Visits of nodes, where one is the child of several: each is another copy of a model. Above: refused.
inline constexpr size_t vox_visits_max = size_t{1} << 20;

/// Voxels that all copies of all models have together: a few seconds. Above: refused.
inline constexpr uint64_t vox_voxels_max = uint64_t{1} << 28;

/// Distance from the origin, voxels of the file: what is farther is in no world. Above: refused.
inline constexpr int64_t vox_far_max = int64_t{1} << 20;

/// Bricks of 8 voxels a side with voxels, 512 bytes each: half a gigabyte. Above: refused.
inline constexpr size_t vox_bricks_max = size_t{1} << 20;

/// Voxels of the world along a side of one of the file (--scale). Above: refused.
inline constexpr double vox_ratio_max = 256.0;

/// Pairs of a node's attributes, and bytes of one of their texts. Above: refused.
inline constexpr uint32_t vox_pairs_max = 64;
inline constexpr uint32_t vox_text_bytes_max = 4096;

}  // namespace scree::limits
