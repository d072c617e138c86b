// The triangles around a body, sorted into bins, to find which of them is nearest to a point. Voxels.
#pragma once

#include <optional>

#include "server/bodies/terrain_mesh.h"

namespace scree {

struct NearestTriangle {
  glm::vec3 normal;  ///< unit, out of the rock
  float distance;    ///< negative behind the triangle, in the rock
};

class TriangleBins {
 public:
  TriangleBins() = default;
  /// Triangles that come into the box.
  TriangleBins(std::vector<TerrainTriangle> triangles, const VoxelBox& box);

  bool empty() const { return triangles_.empty(); }
  const VoxelBox& box() const { return box_; }

  /// The nearest one not farther than `reach`, of those that come into the box.
  std::optional<NearestTriangle> nearest(glm::vec3 p, float reach) const;

 private:
  struct Sphere {
    glm::vec3 middle{0.0F};
    float radius = 0.0F;
  };
  static Sphere sphere_around(const TerrainTriangle& triangle);
  int bin(int axis, float x) const;

  VoxelBox box_;
  VoxelCoord size_;                         ///< in bins
  float extent_ = 0.0F;                     ///< the largest sphere's radius
  std::vector<TerrainTriangle> triangles_;  ///< in order of bins
  std::vector<Sphere> spheres_;             ///< around each
  std::vector<uint32_t> first_;             ///< of each bin, and the end
};

}  // namespace scree
