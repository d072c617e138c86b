// A spatial index of a mesh's triangles. Voxels; deterministic.
#pragma once

#include <vector>

#include "shared/fracture/polygon_mesh.h"

namespace scree {

/// Faces of a mesh in the blocks of a grid. The mesh must outlive it.
class TriangleGrid {
 public:
  explicit TriangleGrid(const PolygonMesh& mesh);

  /// Indices of the faces near the bounds, each once, in order.
  std::vector<uint32_t> near(const PolygonBounds& bounds) const;
  /// Whether the point lies in the closed mesh, by the winding number along z.
  bool holds(glm::dvec3 p) const;

 private:
  struct Blocks {
    VoxelCoord lo, hi;  ///< both inside
  };
  Blocks blocks_of(const PolygonBounds& bounds) const;
  const std::vector<uint32_t>& block(int x, int y, int z) const;
  int winding_above(glm::dvec3 p, const PolygonFace& face) const;

  const PolygonMesh& mesh_;
  PolygonBounds bounds_;
  VoxelCoord size_;
  std::vector<std::vector<uint32_t>> blocks_;
};

}  // namespace scree
