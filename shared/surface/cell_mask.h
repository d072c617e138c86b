// A set of cells of a box, one bit a cell. Units: cells. A value; not thread-safe while written.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/base/check.h"
#include "shared/field/coord.h"

namespace scree {

class CellMask {
 public:
  /// All cells of the box, which has at most 64 along z.
  explicit CellMask(const VoxelBox& cells);

  const VoxelBox& cells() const { return cells_; }
  /// Removes the cells in the box, which may reach beyond this one's.
  void remove(const VoxelBox& box);
  /// Whether the cell belongs to the set.
  bool holds(VoxelCoord cell) const;
  /// Row (x, y), which must lie in the box. Bit i: cell (x, y, lo.z + i).
  uint64_t row(int x, int y) const { return rows_[index(x, y)]; }

 private:
  size_t index(int x, int y) const {
    CHECK_DEBUG(cells_.holds({x, y, cells_.lo.z}));
    return static_cast<size_t>(x - cells_.lo.x) * static_cast<size_t>(cells_.hi.y - cells_.lo.y) +
           static_cast<size_t>(y - cells_.lo.y);
  }

  VoxelBox cells_;
  std::vector<uint64_t> rows_;
};

}  // namespace scree
