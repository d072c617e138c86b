// Whether two windows have the same rock in a cell.
#pragma once

#include <cstdint>
#include <cstring>

#include "shared/field/window.h"

namespace scree {

/// Whether two windows of one box have the same codes at the corners of the cell that begins there.
inline bool is_same_cell(const Window& a, const Window& b, VoxelCoord cell) {
  const size_t first = a.index(cell.x, cell.y, cell.z);
  const auto stride_y = static_cast<size_t>(a.box.size().z);
  const size_t stride_x = stride_y * static_cast<size_t>(a.box.size().y);
  const auto two = [](const Window& window, size_t at) {
    uint16_t codes;
    std::memcpy(&codes, &window.codes[at], sizeof codes);
    return codes;
  };
  for (const size_t at : {first, first + stride_y, first + stride_x, first + stride_x + stride_y})
    if (two(a, at) != two(b, at)) return false;
  return true;
}

}  // namespace scree
