// What the voxels of a brick are of. Untouched terrain says nothing, and takes no memory for it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shared/field/brick.h"
#include "shared/material/material.h"

namespace scree {

/// What a voxel says of its material: 0, the ground's own (ground_materials.h), or 1 + a palette's row.
using VoxelMaterial = uint8_t;
inline constexpr VoxelMaterial ground_own = 0;

constexpr VoxelMaterial said(Material material) {
  return static_cast<VoxelMaterial>(row_number(material) + 1);
}
/// The material that a voxel names; not of ground_own.
constexpr Material material_of(VoxelMaterial voxel) {
  CHECK_DEBUG(voxel != ground_own);
  return static_cast<Material>(voxel - 1);
}

/// One value for a brick in each of a brick's voxels, in its order.
using VoxelMaterials = std::array<VoxelMaterial, brick_voxels>;

/// One value for all voxels, or a plane of 512 indices, packed at 1, 2, 4 or 8 bits, into its own list. An
/// immutable value that is cheap to copy. Invariant: equal contents have equal forms.
class BrickMaterials {
 public:
  BrickMaterials() = default;  ///< the ground's own
  explicit BrickMaterials(VoxelMaterial all) : all_(all) {}
  explicit BrickMaterials(const VoxelMaterials& voxels);

  bool is_uniform() const { return plane_ == nullptr; }
  /// Whether no voxel says anything.
  bool is_ground() const { return plane_ == nullptr && all_ == ground_own; }
  VoxelMaterial uniform() const {
    CHECK_DEBUG(is_uniform());
    return all_;
  }
  VoxelMaterial at(int index) const;
  /// Whether any voxel is of the ground's own.
  bool says_ground() const { return (plane_ == nullptr ? all_ : *listed()) == ground_own; }
  void unpack(VoxelMaterials& to) const;
  VoxelMaterials unpacked() const;
  /// The values that occur, in order.
  std::vector<VoxelMaterial> list() const;
  /// What it takes in memory beside its own size.
  size_t bytes() const;

  /// hash_of_voxels() of voxels that differ: it is kept, since bricks are hashed more often than changed.
  uint64_t hash_of_plane() const;

  bool operator==(const BrickMaterials& other) const;

 private:
  /// The values that occur, in order, at least two; and the indices into them, the first in the lowest bits.
  size_t values() const { return size_t{count_less_one_} + 1; }
  const VoxelMaterial* listed() const { return plane_.get() + sizeof(uint64_t); }
  const uint8_t* packed() const { return listed() + values(); }
  size_t plane_bytes() const;
  std::shared_ptr<uint8_t[]> plane_of(const VoxelMaterials& voxels) const;
  void pack(const VoxelMaterials& voxels);

  std::shared_ptr<const uint8_t[]> plane_;  ///< hash, list and indices in one; null: all_ of every voxel
  VoxelMaterial all_ = ground_own;
  uint8_t count_less_one_ = 0;  ///< values of the list, less one
};

/// XXH3 of the coordinate, the codes, and what the voxels say: nothing where all are the ground's own, a
/// material's number where all are of it, else the hash of 512 values.
uint64_t brick_hash(BrickCoord coord, const Brick& brick, const BrickMaterials& materials);

}  // namespace scree
