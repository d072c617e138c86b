// The terrain as triangles, block by block, made when a body comes near and again when the terrain has
// changed there: the mesh that is drawn (shared/surface/surface_nets.h), as the paper collides with what is
// on screen. Voxels, world axes. Not thread-safe.
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
  /// `field` must outlive this.
  explicit TerrainMesh(Field& field) : field_(field) {}

  /// Every triangle that comes into the box, in an order that depends on the box and the field alone.
  std::vector<TerrainTriangle> near(const VoxelBox& box);

  /// Blocks that read from this box are made anew when they are next asked for.
  void terrain_changed(const VoxelBox& box);

 private:
  const std::vector<TerrainTriangle>& block(VoxelCoord coord);

  Field& field_;
  std::unordered_map<VoxelCoord, std::vector<TerrainTriangle>, CoordHash> blocks_;
};

}  // namespace scree
