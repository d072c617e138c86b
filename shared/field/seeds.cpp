#include <algorithm>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "shared/base/random.h"
#include "shared/field/voronoi.h"

namespace scree {

namespace {

/// A seed is given up after so many positions that were too near to others or lost the draw.
constexpr uint32_t tries_per_seed = 32;
constexpr float spacing_voxels = 1.0F;

/// Seeds by unit cell, so that a seed's neighbours are found in constant time.
class SpacedSeeds {
 public:
  bool add(glm::vec3 p) {
    const VoxelCoord home = cell(p);
    for (int i = 0; i < 27; ++i) {
      const auto found = cells_.find(home + VoxelCoord{i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1});
      if (found == cells_.end()) continue;
      const glm::vec3 off = found->second - p;
      if (glm::dot(off, off) < spacing_voxels * spacing_voxels) return false;
    }
    // Two seeds of one cell can be a voxel apart; keeping one a cell is what makes the look-up simple.
    if (!cells_.try_emplace(home, p).second) return false;
    seeds.push_back(p);
    return true;
  }

  std::vector<glm::vec3> seeds;

 private:
  static VoxelCoord cell(glm::vec3 p) { return {floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)}; }
  std::unordered_map<VoxelCoord, glm::vec3, CoordHash> cells_;
};

struct SolidVoxels {
  std::vector<VoxelCoord> voxels;
  float nearest2 = 0.0F;  ///< squared distance of the impact to the nearest of them
};

SolidVoxels solid_voxels(const Window& volume, glm::vec3 impact) {
  SolidVoxels out;
  const VoxelBox& box = volume.box;
  size_t i = 0;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z, ++i) {
        if (volume.codes[i] >= 0) continue;
        const glm::vec3 off = glm::vec3(x, y, z) - impact;
        const float d2 = glm::dot(off, off);
        out.nearest2 = out.voxels.empty() ? d2 : std::min(out.nearest2, d2);
        out.voxels.push_back({x, y, z});
      }
  return out;
}

}  // namespace

std::vector<glm::vec3> scatter_seeds(const Window& volume, SeedPattern pattern, uint32_t count,
                                     uint32_t random_seed, glm::vec3 impact_voxels) {
  const SolidVoxels solid = solid_voxels(volume, impact_voxels);
  if (solid.voxels.empty()) return {};
  // Within a voxel of the impact the density is that at one voxel: 1/d² has no bound.
  const float nearest2 = std::max(1.0F, solid.nearest2);
  Random random(random_seed);
  SpacedSeeds out;
  const uint64_t tries_max = static_cast<uint64_t>(count) * tries_per_seed;
  for (uint64_t tries = 0; tries < tries_max && out.seeds.size() < count; ++tries) {
    const VoxelCoord voxel = solid.voxels[random.below(static_cast<uint32_t>(solid.voxels.size()))];
    const float dx = random.unit() - 0.5F, dy = random.unit() - 0.5F, dz = random.unit() - 0.5F;
    const glm::vec3 p(static_cast<float>(voxel.x) + dx, static_cast<float>(voxel.y) + dy,
                      static_cast<float>(voxel.z) + dz);
    const glm::vec3 off = p - impact_voxels;
    const float draw = random.unit();
    const bool wanted = pattern == SeedPattern::uniform || draw * glm::dot(off, off) < nearest2;
    // A radial pattern that keeps losing its draws falls back to uniform for the last quarter of the tries.
    if (wanted || tries > tries_max - tries_max / 4) out.add(p);
  }
  return std::move(out.seeds);
}

}  // namespace scree
