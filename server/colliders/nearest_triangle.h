// Finds the triangle nearest to a point among the triangles around a body, which are sorted into bins.
// Voxels.
#pragma once

#include <optional>

#include "server/colliders/terrain_mesh.h"

namespace scree {

struct NearestTriangle {
  glm::vec3 normal;  ///< unit, out of the rock
  float distance;    ///< negative behind the triangle, in the rock
};

class TriangleBins {
 public:
  TriangleBins() = default;
  /// `triangles`: all that touch the box, as TerrainMesh::near() returns them.
  TriangleBins(std::vector<TerrainTriangle> triangles, const VoxelBox& box);

  bool empty() const { return triangles_.empty(); }
  const VoxelBox& box() const { return box_; }

  /// The nearest triangle that is not farther than `reach`, which is positive.
  std::optional<NearestTriangle> nearest(glm::vec3 p, float reach) const;

 private:
  struct Sphere {
    glm::vec3 middle{0.0F};
    float radius = 0.0F;
  };
  static Sphere sphere_around(const TerrainTriangle& triangle);
  int bin(int axis, float x) const;

  VoxelBox box_;
  VoxelCoord size_;                         ///< of the box, in bins
  float extent_ = 0.0F;                     ///< radius of the largest sphere
  std::vector<TerrainTriangle> triangles_;  ///< in order of bins
  std::vector<Sphere> spheres_;             ///< around each triangle, in the same order
  std::vector<uint32_t> first_;             ///< index of each bin's first triangle; last: the end
};

}  // namespace scree
