#include "tools/import/solid_materials.h"

#include <algorithm>
#include <map>

namespace scree {

namespace {

VoxelCoord voxel_in_brick(VoxelCoord first, int index) {
  return first + VoxelCoord{index >> 6, (index >> 3) & 7, index & 7};
}

/// The materials of one brick's rock, asked of each solid once.
class BrickSayings {
 public:
  BrickSayings(const SolidRock& rock, BrickCoord brick) : rock_(rock), brick_(brick) {}

  VoxelMaterial at(uint32_t owner, int index) {
    if (last_ == nullptr || owner != last_owner_) {
      const auto [found, is_new] = said_.try_emplace(owner);
      if (is_new) found->second = rock_.solids[owner]->materials(brick_);
      last_ = &found->second;
      last_owner_ = owner;
    }
    const VoxelMaterial own = last_->at(index);
    return own == ground_own && rock_.otherwise ? said(*rock_.otherwise) : own;
  }

 private:
  const SolidRock& rock_;
  BrickCoord brick_;
  std::map<uint32_t, BrickMaterials> said_;
  const BrickMaterials* last_ = nullptr;
  uint32_t last_owner_ = 0;
};

VoxelMaterial most_frequent(const std::array<int, 256>& votes) {
  return static_cast<VoxelMaterial>(std::ranges::max_element(votes) - votes.begin());
}

BrickMaterials of_brick(const Brick& united, BrickCoord brick, const SolidRock& rock,
                        const BrickMaterials& under) {
  BrickSayings sayings(rock, brick);
  const VoxelCoord first = first_voxel(brick);
  VoxelMaterials voxels = under.unpacked();
  std::array<int, 256> votes{};
  std::array<bool, brick_voxels> is_theirs{};
  for (int i = 0; i < brick_voxels; ++i) {
    const VoxelCoord voxel = voxel_in_brick(first, i);
    if (rock.codes != nullptr && rock.codes->at(voxel.x, voxel.y, voxel.z) >= surface_code) continue;
    const VoxelMaterial own = sayings.at(rock.owners.at(voxel), i);
    is_theirs[static_cast<size_t>(i)] = true;
    if (own == ground_own) continue;
    voxels[static_cast<size_t>(i)] = own;
    ++votes[own];
  }
  const VoxelMaterial most = most_frequent(votes);
  if (most == ground_own) return BrickMaterials(voxels);
  for (size_t i = 0; i < voxels.size(); ++i)
    if (!is_theirs[i] && united.codes[i] >= 0) voxels[i] = most;
  return BrickMaterials(voxels);
}

bool has_rock(const SolidRock& rock, BrickCoord brick) {
  if (rock.codes == nullptr) return true;
  const VoxelCoord first = first_voxel(brick);
  for (int i = 0; i < brick_voxels; ++i) {
    const VoxelCoord voxel = voxel_in_brick(first, i);
    if (rock.codes->at(voxel.x, voxel.y, voxel.z) < surface_code) return true;
  }
  return false;
}

}  // namespace

uint32_t SolidOwners::at(VoxelCoord voxel) const {
  if (each.empty()) return all;
  const VoxelCoord size = box.size(), in = voxel - box.lo;
  return each[(static_cast<size_t>(in.x) * static_cast<size_t>(size.y) + static_cast<size_t>(in.y)) *
                  static_cast<size_t>(size.z) +
              static_cast<size_t>(in.z)];
}

std::shared_ptr<const PackedChunkMaterials> united_materials(const GeneratedChunk& chunk, ChunkCoord at,
                                                             const SolidRock& rock,
                                                             const GeneratedChunk* under) {
  ChunkMaterials materials;
  for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i) {
    const BrickCoord brick = brick_in_chunk(at, i);
    const Brick& united = *chunk.bricks[static_cast<size_t>(i)];
    BrickMaterials& own = materials[static_cast<size_t>(i)];
    if (under != nullptr) own = under->materials(i);
    if (&united != &air_brick() && has_rock(rock, brick)) own = of_brick(united, brick, rock, own);
  }
  return stored_materials_of(materials);
}

}  // namespace scree
