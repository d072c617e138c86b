// What unedited ground is made of, voxel by voxel: what a stored chunk says, else layers: soil over the bulk,
// a cap on the heights (GroundRows, MaterialHeights). A function of the terrain's source and of the place
// alone, the same bits on both sides, so it never crosses the wire.
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>

#include "shared/field/brick_materials.h"
#include "shared/field/terrain.h"

namespace scree {

/// Whether ground at that height may have another material than its bulk.
bool may_be_layered(const TerrainSource& source, BrickCoord coord);

/// Of a brick of that chunk of ground. Every voxel names a material. Solid voxels with air at the depth of a
/// layer above them, in whole voxels, are of that layer; all others, also those above the undisturbed ground,
/// are of the bulk.
BrickMaterials ground_materials_of(const TerrainSource& source, BrickCoord coord,
                                   const GeneratedChunk& generated);

/// Keeps what was computed, as far as there is room: beyond, it forgets all. Not thread-safe.
class GroundMaterialCache {
 public:
  /// Valid until the next call.
  const BrickMaterials& of(const TerrainSource& source, BrickCoord coord, const GeneratedChunk& generated);
  size_t bytes() const { return bytes_; }

 private:
  std::unordered_map<BrickCoord, BrickMaterials, CoordHash> bricks_;
  BrickMaterials last_;  ///< of ground whose tiles are not all there, which may change
  size_t bytes_ = 0;
};

}  // namespace scree
