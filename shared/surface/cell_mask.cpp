#include "shared/surface/cell_mask.h"

#include "shared/base/check.h"

namespace scree {
namespace {

/// Bits lo … hi − 1.
uint64_t bits(int lo, int hi) {
  CHECK_DEBUG(lo >= 0 && lo < hi && hi <= 64);
  const uint64_t below = hi == 64 ? ~uint64_t{0} : (uint64_t{1} << hi) - 1;
  return below & ~((uint64_t{1} << lo) - 1);
}

}  // namespace

CellMask::CellMask(const VoxelBox& cells) : cells_(cells) {
  const VoxelCoord size = cells.size();
  CHECK(!cells.empty() && size.z <= 64);
  rows_.assign(static_cast<size_t>(size.x) * static_cast<size_t>(size.y), bits(0, size.z));
}

void CellMask::remove(const VoxelBox& box) {
  const VoxelBox part = common(box, cells_);
  if (part.empty()) return;
  const uint64_t gone = bits(part.lo.z - cells_.lo.z, part.hi.z - cells_.lo.z);
  for (int x = part.lo.x; x < part.hi.x; ++x)
    for (int y = part.lo.y; y < part.hi.y; ++y) rows_[index(x, y)] &= ~gone;
}

bool CellMask::holds(VoxelCoord cell) const {
  return cells_.holds(cell) && ((row(cell.x, cell.y) >> (cell.z - cells_.lo.z)) & 1U) != 0;
}

}  // namespace scree
