#include "shared/field/ground_materials.h"

#include "shared/base/limits.h"
#include "shared/field/ground_layers.h"

namespace scree {

BrickMaterials ground_materials_of(const TerrainSource& source, BrickCoord coord,
                                   const GeneratedChunk& generated) {
  const GroundLayers layers(source);
  const VoxelCoord first = first_voxel(coord);
  const BrickMaterials stored = generated.materials(index_in_chunk(coord));
  if (!stored.says_ground()) return stored;
  BrickMaterials below = layers.bulk();
  if (layers.possible(first.y, first.y + brick_size))
    below = layers.of_brick(first.y, [&](int x, int y, int z) {
      const VoxelCoord v = first + VoxelCoord{x, y, z};
      return ground_density(source, glm::vec3(v.x, v.y, v.z) * source.voxel_size_m) < 0.0F;
    });
  if (stored.is_ground()) return below;
  VoxelMaterials voxels = stored.unpacked();
  const VoxelMaterials others = below.unpacked();
  for (size_t i = 0; i < voxels.size(); ++i)
    if (voxels[i] == ground_own) voxels[i] = others[i];
  return BrickMaterials(voxels);
}

const BrickMaterials& GroundMaterialCache::of(const TerrainSource& source, BrickCoord coord,
                                              const GeneratedChunk& generated) {
  if (const auto found = bricks_.find(coord); found != bricks_.end()) return found->second;
  last_ = ground_materials_of(source, coord, generated);
  if (!generated.exact) return last_;
  if (bytes_ > limits::ground_materials_bytes_max) {
    bricks_.clear();
    bytes_ = 0;
  }
  constexpr size_t node_bytes = 64;  // of a map's node, about
  bytes_ += node_bytes + last_.bytes();
  return bricks_.emplace(coord, last_).first->second;
}

}  // namespace scree
