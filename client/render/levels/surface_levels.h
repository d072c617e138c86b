// The field at every level of detail, as windows for meshing: level 0 is the field itself; a coarser one is
// generated at its own spacing and takes the samples of what was edited from the field. Nothing is kept that
// an edit could make stale. Not thread-safe.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "client/render/levels/block_windows.h"

namespace scree {

class SurfaceLevels {
 public:
  SurfaceLevels(const TerrainSource& source, int levels);

  /// The terrain with the level's spacing: what generates its chunks.
  const TerrainSource& source(int level) const { return sources_[static_cast<size_t>(level)]; }
  /// Chunks of the level, of 32³ of its samples. `field` is always the world's, of level 0.
  bool has_generated(const Field& field, int level, ChunkCoord chunk) const;
  void adopt_generated(Field& field, int level, ChunkCoord chunk, GeneratedChunk&& generated);

  /// As block_windows.h says, in samples of the level.
  std::optional<BlockWindows> gather(Field& field, int level, const VoxelBox& owned);
  /// Where gather() finds nothing but one of both.
  bool is_rock(Field& field, int level, VoxelCoord sample);

 private:
  std::vector<TerrainSource> sources_;
  std::vector<std::unique_ptr<MapField>> coarse_;  ///< none for level 0
};

}  // namespace scree
