// Flat ground, its surface at y = 0, of voxels as large as in most tests.
#pragma once

#include "content/builtin_palette.h"
#include "shared/field/terrain.h"
#include "shared/material/rubble.h"

namespace scree {

inline constexpr float voxel_m = 0.25F;
inline const TerrainSource flat_terrain{TerrainKind::flat, 1, voxel_m};
/// The same, of rock up to its surface.
inline const TerrainSource rock_terrain{
    TerrainKind::flat, 1, voxel_m, {}, {material::rock, material::rock, material::rock, 1.0F, 1.5F}};

/// Such terrain as worlds of the built-in palette have it: merges make rubble.
inline TerrainSource terrain_of_worlds(TerrainSource source) {
  source.rubble = Rubble(rubble_rows(builtin_palette()));
  return source;
}

}  // namespace scree
