#include "shared/query/volume_cells.h"

namespace scree {

VolumeCells::VolumeCells(const Window& window) : window_(window) {
  if (window.box.empty()) return;
  lo_ = brick_of(window.box.lo - VoxelCoord{1, 1, 1});
  size_ = brick_of(window.box.hi - VoxelCoord{1, 1, 1}) - lo_ + BrickCoord{1, 1, 1};
  slots_.resize(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y) * static_cast<size_t>(size_.z));
}

const CellBlock* VolumeCells::block(BrickCoord coord) {
  const BrickCoord at = coord - lo_;
  if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= size_.x || at.y >= size_.y || at.z >= size_.z)
    return nullptr;
  Slot& slot = slots_[static_cast<size_t>((at.x * size_.y + at.y) * size_.z + at.z)];
  if (!slot.looked) {
    slot.looked = true;
    Window codes(CellBlock::box_of(coord));
    const VoxelBox part = common(codes.box, window_.box);
    if (!part.empty()) put(part_of(window_, part), codes);
    auto made = std::make_unique<CellBlock>(coord, codes.codes.data());
    if (made->any()) slot.block = std::move(made);
  }
  return slot.block.get();
}

bool VolumeCells::is_rock(VoxelCoord voxel) {
  return window_.box.holds(voxel) && window_.at(voxel.x, voxel.y, voxel.z) < 0;
}

}  // namespace scree
