// Flat ground, its surface at y = 0, of voxels as large as in most tests.
#pragma once

#include "shared/field/terrain.h"

namespace scree {

inline constexpr float voxel_m = 0.25F;
inline const TerrainSource flat_terrain{TerrainKind::flat, 1, voxel_m};

}  // namespace scree
