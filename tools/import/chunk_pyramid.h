// Stored chunks, and the coarser levels that show them from afar: every second voxel of a level, distances
// made anew.
#pragma once

#include <map>
#include <memory>

#include "ground/ground_writer.h"
#include "shared/field/terrain.h"

namespace scree {

/// Voxels around a chunk that decide its distances, as for other ground (terrain.cpp).
inline constexpr int chunk_apron = 4;

class ChunkPyramid {
 public:
  using Level = std::map<ChunkCoord, std::shared_ptr<const GeneratedChunk>>;

  /// `bare`: the ground without stored chunks. `finest`: not empty.
  ChunkPyramid(const TerrainSource& bare, Level finest);

  const BrickLayout& layout() const { return layout_; }
  /// Adds the chunks of all levels. Once.
  void write(GroundWriter& writer);

 private:
  Level coarser(const Level& fine, int level) const;

  const TerrainSource bare_;
  Level level_;
  BrickLayout layout_;
};

}  // namespace scree
