#include "shared/query/field_cells.h"

#include <algorithm>

#include "shared/query/limits.h"

namespace scree {

void FieldCells::begin() {
  if (blocks_ > limits::query_blocks_kept || chunks_.size() > limits::query_chunks_kept) {
    chunks_.clear();
    blocks_ = 0;
    last_ = nullptr;
  }
  has_entered_ = false;
  entered_ = 0;
  exact_ = true;
}

void FieldCells::forget(const VoxelBox& changed) {
  // A block has codes from `apron` voxels below its first one, and so many above.
  constexpr int reach = CellBlock::side;
  for_each_chunk(changed.grown(reach), [&](ChunkCoord coord) { chunks_.erase(coord); });
  last_ = nullptr;
}

FieldCells::ChunkCells& FieldCells::chunk(ChunkCoord coord) {
  if (last_ != nullptr && last_coord_ == coord) return *last_;
  const auto [found, is_new] = chunks_.try_emplace(coord);
  ChunkCells& cells = found->second;
  if (is_new) {
    const Field::ChunkBricks bricks = field_.chunk_bricks(coord);
    cells.exact = bricks.generated.exact;
    for (size_t i = 0; i < chunk_brick_count; ++i) {
      const uint64_t bit = uint64_t{1} << i;
      if (bricks.generated.bricks[i] == &air_brick()) cells.air |= bit;
      if (bricks.generated.bricks[i] == &solid_brick()) cells.rock |= bit;
    }
    cells.air &= ~bricks.edited;
    cells.rock &= ~bricks.edited;
    cells.known = cells.air | cells.rock;
  }
  last_coord_ = coord;
  last_ = &cells;
  return cells;
}

FieldCells::BrickSide FieldCells::side_of(BrickCoord coord) {
  ChunkCells& cells = chunk(chunk_of(coord));
  const uint64_t bit = uint64_t{1} << index_in_chunk(coord);
  if ((cells.known & bit) == 0) {
    const Brick& brick = field_.brick(coord);
    Code all = -1, any = 0;
    for (const Code code : brick.codes) {
      all = static_cast<Code>(all & code);
      any = static_cast<Code>(any | code);
    }
    if (all < 0) cells.rock |= bit;
    if (any >= 0) cells.air |= bit;
    cells.known |= bit;
  }
  if ((cells.air & bit) != 0) return BrickSide::air;
  return (cells.rock & bit) != 0 ? BrickSide::rock : BrickSide::both;
}

/// Whether the bricks of the block's voxels are not all air, nor all rock.
bool FieldCells::may_be_crossed(const ChunkCells& cells, BrickCoord coord) {
  // The eight bricks from one on, where all of them are the chunk's.
  constexpr uint64_t eight = 0x330033U;
  const int at = index_in_chunk(coord);
  constexpr int last = chunk_bricks - 1;
  if ((at & last) != last && ((at >> 2) & last) != last && (at >> 4) != last) {
    const uint64_t around = eight << at;
    if ((cells.air & around) == around || (cells.rock & around) == around) return false;
  }
  const BrickSide first = side_of(coord);
  if (first == BrickSide::both) return true;
  for (int i = 1; i < 8; ++i)
    if (side_of(coord + BrickCoord{i >> 2, (i >> 1) & 1, i & 1}) != first) return true;
  return false;
}

const CellBlock* FieldCells::block(BrickCoord coord) {
  const ChunkCoord at = chunk_of(coord);
  ChunkCells& cells = chunk(at);
  if (!has_entered_ || entered_coord_ != at) {
    ++entered_;
    entered_coord_ = at;
    has_entered_ = true;
    exact_ = exact_ && cells.exact;
  }
  const auto index = static_cast<size_t>(index_in_chunk(coord));
  const uint64_t bit = uint64_t{1} << index;
  if ((cells.looked & bit) == 0) {
    cells.looked |= bit;
    if (may_be_crossed(cells, coord)) {
      const Window window = gather(field_, CellBlock::box_of(coord));
      auto made = std::make_unique<CellBlock>(coord, window.codes.data());
      if (made->any()) {
        if (cells.blocks == nullptr)
          cells.blocks.reset(new std::array<std::unique_ptr<CellBlock>, chunk_brick_count>);
        (*cells.blocks)[index] = std::move(made);
        ++blocks_;
      }
    }
  }
  return cells.blocks == nullptr ? nullptr : (*cells.blocks)[index].get();
}

bool FieldCells::is_rock(VoxelCoord voxel) {
  const BrickCoord coord = brick_of(voxel);
  const BrickSide side = side_of(coord);
  if (side != BrickSide::both) return side == BrickSide::rock;
  return field_.brick(coord).codes[static_cast<size_t>(Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7))] <
         0;
}

}  // namespace scree
