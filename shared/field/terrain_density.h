// The density of generated terrain, whose zero set is the surface, over boxes of voxels. Private to the
// ground's own files (terrain.cpp, ground_materials.cpp). Pure; metres.
#pragma once

#include <vector>

#include "shared/field/coord.h"
#include "shared/field/terrain.h"

namespace scree {

/// Above `top` there is only air, below `bottom` only rock.
struct TerrainHeights {
  float bottom_m;
  float top_m;
};
TerrainHeights heights_of(TerrainKind kind);

/// Negative inside rock; in metres, but not a distance. `bump` is the noise at p. The first is of the ground
/// alone, the second with what stands on it (the canyon's arch).
float ground_of(TerrainKind kind, glm::vec3 p, float bump);
float density_of(TerrainKind kind, glm::vec3 p, float bump);

/// What bounds prove of a box: only air, only rock, or neither.
enum class Reach { air, rock, surface };
Reach reach_of(const VoxelBox& box, float voxel_size_m, double bottom_m, double top_m);
/// The same of generated terrain, by bounds of its noise.
Reach reach_of(const TerrainSource& source, const VoxelBox& box);

enum class Standing { with_arch, ground_alone };
/// Whether something that stands on the ground may reach into the box.
bool arch_may_reach(const TerrainSource& source, const VoxelBox& box);

/// Densities of generated terrain at the voxels of a box, whose bounds are even, in a window's order; empty
/// where every second of them has one sign, which `sign` then is. They are sampled at every second voxel and
/// interpolated: the density is smooth on that scale.
struct Levels {
  std::vector<float> values;
  float sign = 0.0F;
};
Levels levels_of(const TerrainSource& source, const VoxelBox& box, Standing standing);

}  // namespace scree
