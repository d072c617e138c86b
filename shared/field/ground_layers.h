// The layers of ground that is generated, or made from heights: soil over the bulk, a cap on the heights
// (GroundRows, MaterialHeights). A solid voxel of the undisturbed ground is of a layer if the voxel so far
// above it as the layer is deep, in whole voxels, is air. Pure.
#pragma once

#include <algorithm>

#include "shared/field/brick_materials.h"
#include "shared/field/terrain.h"

namespace scree {

class GroundLayers {
 public:
  explicit GroundLayers(const TerrainSource& source)
      : voxel_size_m_(source.voxel_size_m),
        heights_(layers_of(source)),
        rows_(source.rows),
        soil_depth_(depth_voxels(source.rows.soil_depth_m)),
        cap_depth_(depth_voxels(source.rows.cap_depth_m)) {}

  /// Whether a layer can lie at rows of voxels from `lo` to before `hi`.
  bool possible(int lo, int hi) const {
    return y_m(lo) < heights_.soil_below_m || y_m(hi - 1) > heights_.ice_above_m;
  }
  /// Voxels above a brick that decide its layers.
  int above() const { return std::max(soil_depth_, cap_depth_); }
  BrickMaterials bulk() const { return BrickMaterials(said(rows_.bulk)); }

  /// The materials of a brick whose first row of voxels is `first_y`. `solid(x, y, z)`: whether that voxel of
  /// the brick, or one above it, is undisturbed ground.
  template <typename F>
  BrickMaterials of_brick(int first_y, F&& solid) const {
    VoxelMaterials voxels;
    voxels.fill(said(rows_.bulk));
    for (int y = 0; y < brick_size; ++y) {
      const bool soil = y_m(first_y + y) < heights_.soil_below_m;
      if (!soil && y_m(first_y + y) <= heights_.ice_above_m) continue;
      const int depth = soil ? soil_depth_ : cap_depth_;
      const VoxelMaterial layer = said(soil ? rows_.soil : rows_.cap);
      for (int x = 0; x < brick_size; ++x)
        for (int z = 0; z < brick_size; ++z)
          if (solid(x, y, z) && !solid(x, y + depth, z))
            voxels[static_cast<size_t>(Brick::index(x, y, z))] = layer;
    }
    return BrickMaterials(voxels);
  }

 private:
  int depth_voxels(float depth_m) const {
    return std::max(1, static_cast<int>(depth_m / voxel_size_m_ + 0.5F));
  }
  float y_m(int y) const { return static_cast<float>(y) * voxel_size_m_; }

  float voxel_size_m_;
  MaterialHeights heights_;
  GroundRows rows_;
  int soil_depth_, cap_depth_;
};

/// The layers of a chunk; null where all of it is of the bulk. `solid(x, y, z)`: as of GroundLayers, from the
/// chunk's first voxel.
template <typename F>
std::shared_ptr<const PackedChunkMaterials> layers_of_chunk(const GroundLayers& layers, ChunkCoord chunk,
                                                            F&& solid) {
  ChunkMaterials materials;
  materials.fill(layers.bulk());
  bool any = false;
  const VoxelCoord origin = first_voxel(chunk);
  for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i) {
    const VoxelCoord first = first_voxel(brick_in_chunk(chunk, i)), off = first - origin;
    if (!layers.possible(first.y, first.y + brick_size)) continue;
    BrickMaterials& made = materials[static_cast<size_t>(i)];
    made =
        layers.of_brick(first.y, [&](int x, int y, int z) { return solid(off.x + x, off.y + y, off.z + z); });
    any = any || !(made == layers.bulk());
  }
  if (!any) return nullptr;
  return stored_materials_of(materials);
}

}  // namespace scree
