// The terrain as triangles, in blocks. A block is made when a body comes near, and again after its terrain
// changed. The triangles are those that are drawn (shared/surface/surface_nets.h), as in the paper. Voxels,
// world axes. Not thread-safe.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "shared/field/field.h"

namespace scree {

struct TerrainTriangle {
  std::array<glm::vec3, 3> corners;
  glm::vec3 normal;  ///< unit, out of the rock
};

class TerrainMesh {
 public:
  /// `field` must outlive this object.
  explicit TerrainMesh(const Field& field) : field_(field) {}

  /// Every triangle that touches the box, in an order that depends on the box and the field alone.
  std::vector<TerrainTriangle> near(const VoxelBox& box);

  /// Drops the blocks that read voxels of this box; near() makes them again.
  void terrain_changed(const VoxelBox& box);

 private:
  const std::vector<TerrainTriangle>& block(VoxelCoord coord);

  const Field& field_;
  std::unordered_map<VoxelCoord, std::vector<TerrainTriangle>, CoordHash> blocks_;
};

}  // namespace scree
