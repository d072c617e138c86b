// The surface of a piece's volume, block by block, in the volume's frame. Outside its window all is air.
#pragma once

#include <memory>
#include <vector>

#include "shared/field/window.h"
#include "shared/query/cell_block.h"

namespace scree {

class VolumeCells final : public CellSource {
 public:
  /// The window outlives it.
  explicit VolumeCells(const Window& window);

  const CellBlock* block(BrickCoord coord) override;
  bool is_rock(VoxelCoord voxel) override;
  const VoxelBox* bounds() const override { return &window_.box; }

 private:
  struct Slot {
    std::unique_ptr<CellBlock> block;
    bool looked = false;
  };

  const Window& window_;
  BrickCoord lo_, size_;  ///< the blocks that its surface may cross
  std::vector<Slot> slots_;
};

}  // namespace scree
