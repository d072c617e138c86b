// Bounds of a piece that a request brings (AddPieceRequest). Each says its unit, its reason, and its effect
// at the limit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "shared/field/window.h"

namespace scree::limits {

/// Bytes of its packed volume: a message of a client holds no more. Above: refused.
inline constexpr size_t added_piece_bytes_max = 65000;

/// Voxels along a side of its box: as of an island's, so that it can become terrain. Above: refused.
inline constexpr int added_piece_side_max = 112;

/// Voxels of its box: 40 a side, which take a tick's time. Above: refused.
inline constexpr uint64_t added_piece_voxels_max = uint64_t{1} << 16U;

}  // namespace scree::limits

namespace scree {

inline bool is_box_of_added_piece(const VoxelBox& box) {
  const VoxelCoord size = box.size();
  return std::max({size.x, size.y, size.z}) <= limits::added_piece_side_max &&
         Window::count(box) <= limits::added_piece_voxels_max;
}

}  // namespace scree
