#include "tools/import/vox/voxel_solid.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

#include "tools/import/limits.h"

namespace scree {

namespace {

constexpr int band_around = 4;

class VoxelSolid final : public Solid {
 public:
  VoxelSolid(ColouredBricks bricks, const std::array<VoxelMaterial, 256>& rows, float voxel_size_m)
      : bricks_(std::move(bricks)), rows_(rows), voxel_m_(voxel_size_m) {}

  /// Before all else.
  Result<void> survey() {
    std::optional<VoxelBox> box;
    for (const auto& [at, brick] : bricks_) {
      const VoxelBox own = full_part(at, brick);
      if (!own.empty()) box = box ? hull_of(*box, own) : own;
    }
    if (!box) return fail("it has no voxel that is shown");
    box_ = *box;
    TRY(layout_around(box_, voxel_m_));
    for (const auto& [at, brick] : bricks_) {
      const VoxelCoord first = first_voxel(at);
      for_each_chunk(
          VoxelBox{first, first + VoxelCoord{brick_size, brick_size, brick_size}}.grown(band_around),
          [this](ChunkCoord chunk) { surface_.insert(chunk); });
    }
    return {};
  }

  std::vector<ChunkCoord> surface_chunks() const override { return {surface_.begin(), surface_.end()}; }
  VoxelBox box() const override { return box_; }
  double lowest_m() const override { return static_cast<double>(box_.lo.y) * static_cast<double>(voxel_m_); }
  bool is_inside(VoxelCoord voxel) const override { return colour(voxel) != 0; }
  void read_levels(const VoxelBox& box, std::span<float> levels) const override {
    std::ranges::fill(levels, 0.5F);
    const VoxelCoord size = box.size();
    for_each_brick(box, [&](BrickCoord at) {
      const auto found = bricks_.find(at);
      if (found == bricks_.end()) return;
      const VoxelCoord first = first_voxel(at);
      const VoxelBox part = common(box, {first, first + VoxelCoord{brick_size, brick_size, brick_size}});
      for (int x = part.lo.x; x < part.hi.x; ++x)
        for (int y = part.lo.y; y < part.hi.y; ++y)
          for (int z = part.lo.z; z < part.hi.z; ++z)
            if (found->second[static_cast<size_t>(Brick::index(x & 7, y & 7, z & 7))] != 0)
              levels[(static_cast<size_t>(x - box.lo.x) * static_cast<size_t>(size.y) +
                      static_cast<size_t>(y - box.lo.y)) *
                         static_cast<size_t>(size.z) +
                     static_cast<size_t>(z - box.lo.z)] = -0.5F;
    });
  }
  BrickMaterials materials(BrickCoord brick) const override {
    const auto found = bricks_.find(brick);
    if (found == bricks_.end()) return {};
    VoxelMaterials voxels;
    std::ranges::transform(found->second, voxels.begin(), [this](uint8_t colour) { return rows_[colour]; });
    return BrickMaterials(voxels);
  }

 private:
  uint8_t colour(VoxelCoord voxel) const {
    const auto found = bricks_.find(brick_of(voxel));
    if (found == bricks_.end()) return 0;
    return found->second[static_cast<size_t>(Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7))];
  }
  static VoxelBox full_part(BrickCoord at, const std::array<uint8_t, brick_voxels>& brick) {
    std::optional<VoxelBox> box;
    for (int i = 0; i < brick_voxels; ++i) {
      if (brick[static_cast<size_t>(i)] == 0) continue;
      const VoxelCoord voxel = first_voxel(at) + VoxelCoord{i >> 6, (i >> 3) & 7, i & 7};
      const VoxelBox own{voxel, voxel + VoxelCoord{1, 1, 1}};
      box = box ? hull_of(*box, own) : own;
    }
    return box.value_or(VoxelBox{});
  }

  const ColouredBricks bricks_;
  const std::array<VoxelMaterial, 256> rows_;
  const float voxel_m_;
  std::set<ChunkCoord> surface_;
  VoxelBox box_{};
};

}  // namespace

Result<std::unique_ptr<Solid>> solid_of_voxels(ColouredBricks bricks,
                                               const std::array<VoxelMaterial, 256>& rows,
                                               float voxel_size_m) {
  auto solid = std::make_unique<VoxelSolid>(std::move(bricks), rows, voxel_size_m);
  TRY(solid->survey());
  return solid;
}

}  // namespace scree
