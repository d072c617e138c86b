// The field at every level of detail, as windows for meshing: level 0 is the field itself; a coarser level is
// generated at its spacing, and takes the samples of edited bricks from the field. Keeps no copies of edits.
// Not thread-safe.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "client/render/levels/block_windows.h"

namespace scree {

class SurfaceLevels {
 public:
  SurfaceLevels(const TerrainSource& source, int levels);

  /// The terrain's source with the level's spacing, which generates its chunks.
  const TerrainSource& source(int level) const { return sources_[static_cast<size_t>(level)]; }
  /// Chunks of the level, of 32³ of its samples. `field` is always the world's, of level 0.
  bool has_generated(const Field& field, int level, ChunkCoord chunk) const;
  void adopt_generated(const Field& field, int level, ChunkCoord chunk, GeneratedChunk&& generated);

  /// Like gather_windows() (block_windows.h), in samples of the level.
  std::optional<BlockWindows> gather(const Field& field, int level, const VoxelBox& owned);
  /// Whether a box for which gather() returns nothing is rock, not air.
  bool is_rock(const Field& field, int level, VoxelCoord sample);

 private:
  std::vector<TerrainSource> sources_;
  std::vector<std::unique_ptr<MapField>> coarse_;  ///< none for level 0
};

}  // namespace scree
