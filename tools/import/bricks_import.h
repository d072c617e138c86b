// Makes a ground file of solids: their union with the ground that they stand on. The chunks of the finest
// level lie in memory meanwhile (limits::import_chunks_max bounds them), and those of one coarser level.
#pragma once

#include <functional>
#include <string>

#include "ground/ground_file.h"
#include "tools/import/solid.h"

namespace scree {

struct BricksImport {
  /// What the solids stand on; null: level rock.
  std::shared_ptr<const GroundFile> on{};
  /// Height of the level rock, metres; default: a voxel above the solids' lowest.
  std::optional<double> level_m{};
  std::optional<float> voxel_size_m{};      ///< default: that of `on`'s bricks, or 0.25
  std::optional<MaterialHeights> layers{};  ///< default: those of `on`, or none
  /// What materials are rows of; null: the palette of `on`, or the built-in one. It has all rows of that of
  /// `on`.
  std::shared_ptr<const Palette> palette{};
  std::optional<Material> material{};  ///< of rock for which the solid says none
  double least_m3 = 0.0;               ///< less rock of the solids is refused: they are too thin
  /// The solids' codes are taken as they are, in place of the ground, in this box of chunks alone.
  struct Exact {
    ChunkCoord lo;
    ChunkCoord hi;
  };
  std::optional<Exact> exact{};
};

struct BricksImported {
  GroundHeader header;
  uint64_t bytes = 0;
  size_t chunks = 0;       ///< of the finest level
  double volume_m3 = 0.0;  ///< of the solids together, without the ground
};

/// `progress(part)`: from 0 to 1. The error says what is wrong with the solids, and what may help.
Result<BricksImported> import_bricks(const std::vector<std::unique_ptr<Solid>>& solids,
                                     const std::string& path, const BricksImport& how,
                                     const std::function<void(double)>& progress);

}  // namespace scree
