// What the rock of solids is of, in a chunk of the ground that they are united with.
#pragma once

#include <memory>
#include <vector>

#include "tools/import/solid.h"

namespace scree {

/// A brick with a voxel of the solids below this code shows their surface: half a voxel, rounded up.
inline constexpr Code surface_code = 22;

/// Which of the solids has each voxel of a box.
struct SolidOwners {
  VoxelBox box;
  std::vector<uint32_t> each{};  ///< empty: `all` has all of them
  uint32_t all = 0;

  uint32_t at(VoxelCoord voxel) const;
};

/// The solids' rock in a chunk.
struct SolidRock {
  const std::vector<std::unique_ptr<Solid>>& solids;
  const Window* codes = nullptr;  ///< null: all of the chunk is rock
  SolidOwners owners;
  std::optional<Material> otherwise{};  ///< of rock for which its solid says nothing
};

/// What the voxels of `chunk`, the union, are of. `under`: the stored chunk of the ground below; null: that
/// stores none there, and its layers are to decide. Air has the
/// material that most of the solids' rock in its brick has: so bricks of one material stay uniform.
std::shared_ptr<const PackedChunkMaterials> united_materials(const GeneratedChunk& chunk, ChunkCoord at,
                                                             const SolidRock& rock,
                                                             const GeneratedChunk* under);

}  // namespace scree
