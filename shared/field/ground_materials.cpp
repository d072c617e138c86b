#include "shared/field/ground_materials.h"

#include "shared/base/limits.h"
#include "shared/field/ground_layers.h"

namespace scree {

namespace {

/// Which voxels of a brick's columns are undisturbed ground: by the stored codes, elsewhere by the heights.
class SolidColumns {
 public:
  SolidColumns(const TerrainSource& source, VoxelCoord first)
      : source_(source),
        first_(first),
        patch_(heights_at(*source.heights, first.x, first.z, brick_size, source.voxel_size_m)),
        coord_(chunk_of(first)),
        chunk_(stored_chunk(source, coord_).chunk) {}

  bool at(VoxelCoord v) {
    if (chunk_of(v) != coord_) {
      coord_ = chunk_of(v);
      chunk_ = stored_chunk(source_, coord_).chunk;
    }
    if (chunk_ != nullptr) {
      const Brick& brick = *chunk_->bricks[static_cast<size_t>(index_in_chunk(brick_of(v)))];
      return brick.codes[static_cast<size_t>(Brick::index(v.x & 7, v.y & 7, v.z & 7))] < 0;
    }
    const auto column = static_cast<size_t>((v.z - first_.z) * brick_size + (v.x - first_.x));
    return static_cast<double>(v.y) * static_cast<double>(source_.voxel_size_m) < patch_.heights_m[column];
  }

 private:
  const TerrainSource& source_;
  VoxelCoord first_;
  HeightPatch patch_;
  ChunkCoord coord_;  ///< of the last voxel's chunk
  std::shared_ptr<const GeneratedChunk> chunk_;
};

}  // namespace

BrickMaterials ground_materials_of(const TerrainSource& source, BrickCoord coord,
                                   const GeneratedChunk& generated) {
  const GroundLayers layers(source);
  const VoxelCoord first = first_voxel(coord);
  const BrickMaterials stored = generated.materials(index_in_chunk(coord));
  if (!stored.says_ground()) return stored;
  BrickMaterials below = layers.bulk();
  if (layers.possible(first.y, first.y + brick_size)) {
    SolidColumns columns(source, first);
    below = layers.of_brick(first.y, [&](int x, int y, int z) {
      return columns.at(first + VoxelCoord{x, y, z});
    });
  }
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
  if (!is_here(source, chunk_of(coord))) return last_;
  if (bytes_ > limits::ground_materials_bytes_max) {
    bricks_.clear();
    bytes_ = 0;
  }
  constexpr size_t node_bytes = 64;  // of a map's node, about
  bytes_ += node_bytes + last_.bytes();
  return bricks_.emplace(coord, last_).first->second;
}

MassUnits brick_mass(const TerrainSource& source, BrickCoord coord, const Brick& brick,
                     const BrickMaterials& says, const GeneratedChunk* generated) {
  const RubbleRows& rows = *source.rubble;
  const bool stored = source.heights != nullptr && source.heights->bricks().has_value();
  if (!rows.any || (says.is_ground() && !stored)) return brick_mass(brick);
  VoxelMaterials voxels;
  says.unpack(voxels);
  if (stored && says.says_ground()) {
    VoxelMaterials own;
    const auto made = generated != nullptr ? GeneratedChunk() : generate_chunk(source, chunk_of(coord));
    ground_materials_of(source, coord, generated != nullptr ? *generated : made).unpack(own);
    for (size_t i = 0; i < voxels.size(); ++i)
      if (voxels[i] == ground_own) voxels[i] = own[i];
  }
  MassUnits mass = 0;
  for (size_t i = 0; i < voxels.size(); ++i) {
    const int fill = voxels[i] == ground_own ? fill_solid : rows.fill[row_number(material_of(voxels[i]))];
    mass += mass_in_voxel(occupancy(brick.codes[i]), fill);
  }
  return mass;
}

MassUnits ground_mass(const TerrainSource& source, BrickCoord coord, const GeneratedChunk& generated) {
  const Brick& brick = *generated.bricks[static_cast<size_t>(index_in_chunk(coord))];
  return brick_mass(source, coord, brick, BrickMaterials(), &generated);
}

}  // namespace scree
