// The simplifier `merge`: points nearer than a tolerance become one.
#include <glm/geometric.hpp>
#include <unordered_map>

#include "server/fracture/hull_corners.h"
#include "server/fracture/point_spread.h"
#include "server/fracture/simplify.h"
#include "shared/base/check.h"

namespace scree {

namespace {

constexpr float merge_tolerance_voxels = 1.0F;

/// Points that become one: the first, which decides whether others join, and the sum of all.
struct Cluster {
  glm::vec3 first;
  glm::vec3 sum;
  float count;
};

std::vector<Cluster> clusters_of(const std::vector<glm::vec3>& points, float tolerance) {
  std::vector<Cluster> clusters;
  std::unordered_map<VoxelCoord, std::vector<size_t>, CoordHash> cubes;
  const auto near = [&](glm::vec3 p, VoxelCoord home) -> Cluster* {
    for (int i = 0; i < 27; ++i) {
      const auto cube = cubes.find(home + VoxelCoord{i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1});
      if (cube == cubes.end()) continue;
      for (const size_t c : cube->second) {
        const glm::vec3 off = clusters[c].first - p;
        if (glm::dot(off, off) < tolerance * tolerance) return &clusters[c];
      }
    }
    return nullptr;
  };
  for (const glm::vec3& p : points) {
    const VoxelCoord home = cube_around(p, tolerance);
    if (Cluster* cluster = near(p, home)) {
      cluster->sum += p;
      cluster->count += 1.0F;
    } else {
      cubes[home].push_back(clusters.size());
      clusters.push_back({p, p, 1.0F});
    }
  }
  return clusters;
}

}  // namespace

std::vector<glm::vec3> merge_near(const std::vector<glm::vec3>& points, size_t count_max) {
  CHECK(count_max > 0);
  std::vector<Cluster> clusters = clusters_of(points, merge_tolerance_voxels);
  for (float tolerance = merge_tolerance_voxels * thinning_growth; clusters.size() > count_max;
       tolerance *= thinning_growth)
    clusters = clusters_of(points, tolerance);
  std::vector<glm::vec3> merged;
  for (const Cluster& cluster : clusters) merged.push_back(cluster.sum / cluster.count);
  return merged;
}

std::vector<glm::vec3> choose_means(const std::vector<glm::vec3>& surface) {
  return if_thick(merge_near(surface, merged_points_max));
}

}  // namespace scree
