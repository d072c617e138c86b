// The surface of a field, block by block, with what was read kept for the next question.
#pragma once

#include <array>
#include <memory>
#include <unordered_map>

#include "shared/field/field.h"
#include "shared/query/cell_block.h"

namespace scree {

/// Between questions the field may change, if it is told to forget. The field outlives it.
/// Reading generates ground, and brings in chunks of a field that pages (ChunkUnreadable where that fails).
class FieldCells final : public CellSource {
 public:
  explicit FieldCells(const Field& field) : field_(field) {}

  const Field& field() const { return field_; }
  const CellBlock* block(BrickCoord coord) override;
  bool is_rock(VoxelCoord voxel) override;
  const VoxelBox* bounds() const override { return nullptr; }

  /// Codes of these voxels have changed, or their ground has arrived: what was computed of them is no more.
  void forget(const VoxelBox& changed);
  /// Begins a question: forgets what was kept if it has become too much, and begins the counts anew.
  void begin();
  /// Times that the question came from one chunk into another: it read no more chunks, but for those beside.
  uint32_t chunks() const { return entered_; }
  /// Whether all ground that it came into is the ground's own (Field::adopt_generated).
  bool exact() const { return exact_; }

 private:
  /// Bits by brick. A brick is air when no code is below 0, rock when all are.
  struct ChunkCells {
    uint64_t known = 0;
    uint64_t air = 0;
    uint64_t rock = 0;
    uint64_t looked = 0;  ///< blocks that were made, or found to be without surface
    bool exact = true;
    std::unique_ptr<std::array<std::unique_ptr<CellBlock>, chunk_brick_count>> blocks;  ///< null: none yet
  };
  enum class BrickSide : uint8_t { air, rock, both };

  ChunkCells& chunk(ChunkCoord coord);
  BrickSide side_of(BrickCoord coord);
  bool may_be_crossed(const ChunkCells& cells, BrickCoord coord);

  const Field& field_;
  std::unordered_map<ChunkCoord, ChunkCells, CoordHash> chunks_;
  ChunkCoord last_coord_;
  ChunkCells* last_ = nullptr;
  ChunkCoord entered_coord_;
  bool has_entered_ = false;
  uint32_t entered_ = 0;
  bool exact_ = true;
  size_t blocks_ = 0;
};

}  // namespace scree
