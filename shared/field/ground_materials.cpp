#include "shared/field/ground_materials.h"

#include <algorithm>

#include "shared/base/limits.h"
#include "shared/field/terrain_density.h"

namespace scree {

namespace {

/// Whole voxels of a layer's depth, at least one.
int depth_voxels(float depth_m, float voxel_size_m) {
  return std::max(1, static_cast<int>(depth_m / voxel_size_m + 0.5F));
}

/// The layers of a brick: which of them can lie there, and how deep each reaches.
class Layers {
 public:
  Layers(const TerrainSource& source, BrickCoord coord)
      : source_(source),
        first_(first_voxel(coord)),
        heights_(layers_of(source)),
        soil_depth_(depth_voxels(source.rows.soil_depth_m, source.voxel_size_m)),
        cap_depth_(depth_voxels(source.rows.cap_depth_m, source.voxel_size_m)) {}

  /// Whether heights alone leave a layer any voxel of the brick.
  bool possible() const {
    return y_m(0) < heights_.soil_below_m || y_m(brick_size - 1) > heights_.ice_above_m;
  }
  /// Voxels above the brick that decide its layers.
  int above() const { return std::max(soil_depth_, cap_depth_); }

  /// `solid(x, y, z)`: whether that voxel of the brick, or one above it, is undisturbed ground.
  template <typename F>
  BrickMaterials by(F&& solid) const {
    VoxelMaterials voxels;
    for (int x = 0; x < brick_size; ++x)
      for (int y = 0; y < brick_size; ++y) {
        const bool soil = y_m(y) < heights_.soil_below_m;
        const bool layered = soil || y_m(y) > heights_.ice_above_m;
        const int depth = soil ? soil_depth_ : cap_depth_;
        const VoxelMaterial layer = said(soil ? source_.rows.soil : source_.rows.cap);
        for (int z = 0; z < brick_size; ++z)
          voxels[static_cast<size_t>(Brick::index(x, y, z))] =
              layered && solid(x, y, z) && !solid(x, y + depth, z) ? layer : said(source_.rows.bulk);
      }
    return BrickMaterials(voxels);
  }

  BrickMaterials of_heights() const {
    const HeightPatch patch =
        heights_at(*source_.heights, first_.x, first_.z, brick_size, source_.voxel_size_m);
    const auto metres = [&](int y) {
      return static_cast<double>(first_.y + y) * static_cast<double>(source_.voxel_size_m);
    };
    return by([&](int x, int y, int z) {
      return metres(y) < patch.heights_m[static_cast<size_t>(z * brick_size + x)];
    });
  }

  BrickMaterials of_stored_codes() const {
    return by([&](int x, int y, int z) {
      const VoxelCoord v = first_ + VoxelCoord{x, y, z};
      return ground_density(source_, glm::vec3(v.x, v.y, v.z) * source_.voxel_size_m) < 0.0F;
    });
  }

  BrickMaterials generated() const {
    const int rows = (brick_size + above() + 1) / 2 * 2;
    const VoxelBox box{first_, first_ + VoxelCoord{brick_size, rows, brick_size}};
    const BrickMaterials bulk(said(source_.rows.bulk));
    if (reach_of(source_, box) == Reach::rock) return bulk;  // all is deeper than the layers
    const Levels levels = levels_of(source_, box, Standing::ground_alone);
    if (levels.values.empty()) return bulk;
    return by([&](int x, int y, int z) {
      return levels.values[static_cast<size_t>((x * rows + y) * brick_size + z)] < 0.0F;
    });
  }

 private:
  float y_m(int y) const { return static_cast<float>(first_.y + y) * source_.voxel_size_m; }

  const TerrainSource& source_;
  VoxelCoord first_;
  MaterialHeights heights_;
  int soil_depth_, cap_depth_;
};

BrickMaterials layers_of_brick(const TerrainSource& source, BrickCoord coord) {
  const Layers layers(source, coord);
  if (!layers.possible()) return BrickMaterials(said(source.rows.bulk));
  if (source.heights == nullptr) return layers.generated();
  return source.heights->bricks() ? layers.of_stored_codes() : layers.of_heights();
}

}  // namespace

bool may_be_layered(const TerrainSource& source, BrickCoord coord) {
  if (source.heights != nullptr && source.heights->bricks()) return true;
  return Layers(source, coord).possible();
}

BrickMaterials ground_materials_of(const TerrainSource& source, BrickCoord coord,
                                   const GeneratedChunk& generated) {
  const BrickMaterials stored = generated.materials(index_in_chunk(coord));
  if (stored.is_ground()) return layers_of_brick(source, coord);
  if (stored.is_uniform()) return stored;
  VoxelMaterials voxels = stored.unpacked();
  if (std::ranges::find(voxels, ground_own) == voxels.end()) return stored;
  const VoxelMaterials layers = layers_of_brick(source, coord).unpacked();
  for (size_t i = 0; i < voxels.size(); ++i)
    if (voxels[i] == ground_own) voxels[i] = layers[i];
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
