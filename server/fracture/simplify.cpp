#include "server/fracture/simplify.h"

#include <glm/geometric.hpp>
#include <unordered_map>
#include <unordered_set>

#include "shared/base/check.h"
#include "shared/field/coord.h"

namespace scree {

namespace {

/// Factor by which cubes and tolerances grow: about two thirds of the points stay each time.
constexpr float growth = 1.25F;

constexpr float merge_tolerance_voxels = 1.0F;

VoxelCoord cube_of(glm::vec3 p, float side) {
  return {floor_to_int(p.x / side), floor_to_int(p.y / side), floor_to_int(p.z / side)};
}

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
    const VoxelCoord home = cube_of(p, tolerance);
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

std::vector<glm::vec3> spread(const std::vector<glm::vec3>& points, float side_voxels, size_t count_max) {
  CHECK(side_voxels > 0.0F && count_max > 0);
  for (float side = side_voxels;; side *= growth) {
    std::unordered_set<VoxelCoord, CoordHash> taken;
    std::vector<glm::vec3> kept;
    for (const glm::vec3& p : points)
      if (taken.insert(cube_of(p, side)).second) kept.push_back(p);
    if (kept.size() <= count_max) return kept;
  }
}

std::vector<glm::vec3> merge_near(const std::vector<glm::vec3>& points, size_t count_max) {
  CHECK(count_max > 0);
  std::vector<Cluster> clusters = clusters_of(points, merge_tolerance_voxels);
  for (float tolerance = merge_tolerance_voxels * growth; clusters.size() > count_max; tolerance *= growth)
    clusters = clusters_of(points, tolerance);
  std::vector<glm::vec3> merged;
  for (const Cluster& cluster : clusters) merged.push_back(cluster.sum / cluster.count);
  return merged;
}

}  // namespace scree
