// A box of rock as a solid, in voxels; and a ground file with some, on rough hills.
#pragma once

#include "tests/support/written_ground.h"
#include "tools/import/bricks_import.h"

namespace scree {

class BoxSolid final : public Solid {
 public:
  explicit BoxSolid(const VoxelBox& box, std::optional<Material> material = std::nullopt)
      : box_(box), material_(material) {}

  std::vector<ChunkCoord> surface_chunks() const override {
    std::vector<ChunkCoord> chunks;
    for_each_chunk(box_.grown(4), [&](ChunkCoord chunk) { chunks.push_back(chunk); });
    return chunks;
  }
  VoxelBox box() const override { return box_; }
  double lowest_m() const override { return 0.25 * box_.lo.y; }
  bool is_inside(VoxelCoord voxel) const override { return box_.holds(voxel); }
  BrickMaterials materials(BrickCoord) const override {
    return BrickMaterials(material_ ? said(*material_) : ground_own);
  }
  /// Its faces lie half a voxel outside of its outermost voxels.
  void read_levels(const VoxelBox& box, std::span<float> levels) const override {
    size_t i = 0;
    const auto outside = [](int at, int lo, int hi) {
      return std::max(static_cast<float>(lo - at) - 0.5F, static_cast<float>(at - hi) + 0.5F);
    };
    for (int x = box.lo.x; x < box.hi.x; ++x)
      for (int y = box.lo.y; y < box.hi.y; ++y)
        for (int z = box.lo.z; z < box.hi.z; ++z)
          levels[i++] = std::max({outside(x, box_.lo.x, box_.hi.x), outside(y, box_.lo.y, box_.hi.y),
                                  outside(z, box_.lo.z, box_.hi.z)});
  }

 private:
  VoxelBox box_;
  std::optional<Material> material_;
};

/// A table of soil over the hills: a slab on one leg, with air below. Voxels of 0.25 m.
inline std::shared_ptr<const GroundFile> written_table(const std::string& path,
                                                       std::shared_ptr<const GroundFile> hills) {
  std::vector<std::unique_ptr<Solid>> solids;
  const int top = static_cast<int>(top_m({.heights = hills}) * 4.0F) + 8;
  solids.push_back(std::make_unique<BoxSolid>(VoxelBox{{-40, top, -40}, {40, top + 8, 40}}, material::soil));
  solids.push_back(std::make_unique<BoxSolid>(VoxelBox{{-6, -200, -6}, {6, top + 4, 6}}));
  const auto imported = import_bricks(solids, path, {.on = std::move(hills)}, [](double) {});
  EXPECT_TRUE(imported) << imported.error().message;
  const auto file = GroundFile::open(path);
  EXPECT_TRUE(file) << file.error().message;
  return file ? *file : nullptr;
}

}  // namespace scree
