// Flat ground, its surface at y = 0, of voxels as large as in most tests.
#pragma once

#include "shared/field/terrain.h"

namespace scree {

inline constexpr float voxel_m = 0.25F;
inline const TerrainSource flat_terrain{TerrainKind::flat, 1, voxel_m};
/// The same, of rock up to its surface.
inline const TerrainSource rock_terrain{
    TerrainKind::flat, 1, voxel_m, {}, {material::rock, material::rock, material::rock, 1.0F, 1.5F}};

}  // namespace scree
