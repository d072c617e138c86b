// Which cells of a box count, one bit a cell. Units: cells. A value; not thread-safe while written.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/field/coord.h"

namespace scree {

class CellMask {
 public:
  /// All of them count. At most 64 along z.
  explicit CellMask(const VoxelBox& cells);

  const VoxelBox& cells() const { return cells_; }
  /// Those in the box count no more.
  void remove(const VoxelBox& box);
  /// Whether the cell is in the box of cells, and counts.
  bool holds(VoxelCoord cell) const;
  /// Bit i: cell (x, y, lo.z + i), of a row in the box.
  uint64_t row(int x, int y) const { return rows_[index(x, y)]; }

 private:
  size_t index(int x, int y) const {
    return static_cast<size_t>(x - cells_.lo.x) * static_cast<size_t>(cells_.hi.y - cells_.lo.y) +
           static_cast<size_t>(y - cells_.lo.y);
  }

  VoxelBox cells_;
  std::vector<uint64_t> rows_;
};

}  // namespace scree
