// What bricks say after voxels of a box became of other materials.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/field/eight_bytes.h"
#include "shared/field/material_window.h"

namespace scree {

/// Changes of what a reader read. The field stays as it is; scatter() writes what says() returns.
class MaterialChanges {
 public:
  /// The reader must outlive it.
  explicit MaterialChanges(const MaterialReader& were);

  /// Calls `material_of(voxel, its place, was)` for each voxel of the reader's box whose byte is not 0; the
  /// voxel becomes of what it returns. `where`: a byte for each voxel, in a window's order.
  template <typename F>
  void change(std::span<const uint8_t> where, F&& material_of);
  /// A voxel of the box becomes of another material than it was.
  void set(VoxelCoord voxel, Material material) { brick(brick_of(voxel)).set(index_of(voxel), material); }

  /// What bricks say now; those that say another thing, in order. Where a voxel is of the ground's own
  /// material, they say nothing.
  std::vector<BrickSays> says() const;

 private:
  class BrickChange {
   public:
    explicit BrickChange(const MaterialReader::BrickOf& of);

    Material was(size_t index) const { return one_ ? *one_ : of_.at(static_cast<int>(index)); }
    void set(size_t index, Material material);
    bool differs() const { return differs_; }
    BrickMaterials says() const { return BrickMaterials(says_); }

   private:
    const MaterialReader::BrickOf& of_;
    std::optional<Material> one_;
    bool differs_ = false;
    VoxelMaterials says_;  ///< written where it differs
  };
  BrickChange& brick(BrickCoord coord);
  static size_t index_of(VoxelCoord voxel) {
    return static_cast<size_t>(Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7));
  }

  const MaterialReader& were_;
  std::vector<std::unique_ptr<BrickChange>> by_place_;  ///< null: nothing was asked of it
};

template <typename F>
void MaterialChanges::change(std::span<const uint8_t> where, F&& material_of) {
  const VoxelBox& box = were_.box();
  CHECK_EQ(where.size(), Window::count(box));
  const auto row = static_cast<size_t>(box.hi.z - box.lo.z);
  // The row that the last voxel was in: x, y, and the place of its first voxel.
  int x = box.lo.x, y = box.lo.y;
  size_t first = 0;
  for_each_nonzero(where, [&](size_t place) {
    for (; place >= first + row; first += row)
      if (++y == box.hi.y) {
        y = box.lo.y;
        ++x;
      }
    const VoxelCoord voxel{x, y, box.lo.z + static_cast<int>(place - first)};
    BrickChange& of = brick(brick_of(voxel));
    const Material was = of.was(index_of(voxel)), is = material_of(voxel, place, was);
    if (is != was) of.set(index_of(voxel), is);
  });
}

}  // namespace scree
