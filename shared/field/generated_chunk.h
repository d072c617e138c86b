// The bricks of one chunk of unedited ground, generated or stored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "shared/field/brick_materials.h"
#include "shared/field/window.h"

namespace scree {

inline constexpr size_t chunk_brick_count = size_t{chunk_bricks} * chunk_bricks * chunk_bricks;

/// What the bricks of a chunk say of their materials, in their order.
using ChunkMaterials = std::array<BrickMaterials, chunk_brick_count>;

/// Those materials as a chunk holds them, each that differs once.
class PackedChunkMaterials {
 public:
  explicit PackedChunkMaterials(const ChunkMaterials& materials);

  const BrickMaterials& at(int index) const { return distinct_[places_[static_cast<size_t>(index)]]; }
  /// Those that occur, in the order of the first brick of each.
  const std::vector<BrickMaterials>& distinct() const { return distinct_; }
  size_t bytes() const;
  bool operator==(const PackedChunkMaterials& other) const;

 private:
  std::array<uint8_t, chunk_brick_count> places_{};  ///< by brick, in `distinct_`
  std::vector<BrickMaterials> distinct_;
};

/// Null where no brick says anything.
std::shared_ptr<const PackedChunkMaterials> stored_materials_of(const ChunkMaterials& materials);

/// A chunk of the ground. bricks[i] is never null; uniform bricks point to the shared ones.
struct GeneratedChunk {
  std::array<const Brick*, chunk_brick_count> bricks;
  std::unique_ptr<Brick[]> storage;
  uint32_t stored = 0;  ///< bricks in storage
  /// What its bricks are of. Null: all is the ground's bulk; but where a ground stores chunks, that they lie
  /// in its layers, as bricks that say nothing do (ground_materials.h).
  std::shared_ptr<const PackedChunkMaterials> stored_materials;
  /// Whether all that decides it was there. If not, it looks alike, but its codes are not the ground's.
  bool exact = true;

  BrickMaterials materials(int index) const {
    return stored_materials == nullptr ? BrickMaterials() : stored_materials->at(index);
  }
  /// What it takes in memory.
  size_t bytes() const;
};

/// `brick` is one of the shared uniform ones.
GeneratedChunk uniform_chunk(const Brick& brick);

/// The chunk's part of the window, which must hold it.
GeneratedChunk split_into_bricks(const Window& window, ChunkCoord coord);

/// Makes a chunk of those bricks; shared bricks replace uniform ones.
GeneratedChunk chunk_of_bricks(const std::array<Brick, chunk_brick_count>& bricks);

/// Another one that is the same.
GeneratedChunk copy_of(const GeneratedChunk& chunk);

/// Whether codes and materials are the same.
bool same_bricks(const GeneratedChunk& a, const GeneratedChunk& b);

}  // namespace scree
