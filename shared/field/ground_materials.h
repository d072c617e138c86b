// The materials of stored ground where its bricks say nothing: those of its layers (ground_layers.h), by the
// codes that are stored. Ground that is generated brings its materials along (GeneratedChunk). Functions of
// the terrain's source and of the place alone, so none of this crosses the wire.
#pragma once

#include <cstddef>
#include <unordered_map>

#include "shared/field/brick_materials.h"
#include "shared/field/mass.h"
#include "shared/field/terrain.h"

namespace scree {

/// The materials of a brick of that chunk of stored ground. Every voxel names a material.
BrickMaterials ground_materials_of(const TerrainSource& source, BrickCoord coord,
                                   const GeneratedChunk& generated);

/// Mass of a brick whose voxels say that, and of one that nobody edited. A ground's layers are without pores,
/// but its stored bricks may be of rubble.
MassUnits brick_mass(const TerrainSource& source, BrickCoord coord, const Brick& brick,
                     const BrickMaterials& says, const GeneratedChunk* generated = nullptr);
MassUnits ground_mass(const TerrainSource& source, BrickCoord coord, const GeneratedChunk& generated);

/// Keeps what was computed, as far as there is room: beyond, it forgets all. Not thread-safe.
class GroundMaterialCache {
 public:
  /// Valid until the next call.
  const BrickMaterials& of(const TerrainSource& source, BrickCoord coord, const GeneratedChunk& generated);

 private:
  std::unordered_map<BrickCoord, BrickMaterials, CoordHash> bricks_;
  BrickMaterials last_;  ///< of ground whose tiles are not all there, which may change
  size_t bytes_ = 0;
};

}  // namespace scree
