#include "server/fracture/point_spread.h"

#include <unordered_set>

#include "shared/base/check.h"

namespace scree {

std::vector<glm::vec3> spread(const std::vector<glm::vec3>& points, float side_voxels, size_t count_max) {
  CHECK(side_voxels > 0.0F && count_max > 0);
  for (float side = side_voxels;; side *= thinning_growth) {
    std::unordered_set<VoxelCoord, CoordHash> taken;
    std::vector<glm::vec3> kept;
    for (const glm::vec3& p : points)
      if (taken.insert(cube_around(p, side)).second) kept.push_back(p);
    if (kept.size() <= count_max) return kept;
  }
}

}  // namespace scree
