// The vertices of dual contouring (Ju et al. 2002): edges and corners of the rock stay sharp.
//
// Flat faces are found from the codes around a cell (rock_faces.h). If some of these, all convex or all
// concave, explain the codes, and meet in the cell, the vertex is that point. Faces are compared with codes
// on the side where the distance to an edge is exact. In rock it is the largest of the planes' distances, in
// air the smallest. On the other side distances are rounded. So both faces at an edge through the cell are
// found, even if one of them crosses no edge of the cell; the edges of cubes are exact within 0.05 voxel.
// Elsewhere the vertex is the least-squares solution over the planes at the crossings.
//
// Not thread-safe: it caches facets. Units: voxels.
#pragma once

#include <span>

#include "shared/surface/leaf_surface.h"
#include "shared/surface/rock_faces.h"

namespace scree {

class SharpVertices {
 public:
  /// The window must outlive it.
  explicit SharpVertices(const Window& window) : facets_(window) {}

  /// The vertex of the sheet with these crossings of the cell, in sides of the cell from its lowest corner;
  /// it may lie outside the cell. The window reaches two voxels down and three up from the cell's lowest
  /// corner.
  glm::vec3 place(VoxelCoord cell, std::span<const LeafCrossing> crossings);

 private:
  glm::vec3 least_squares(VoxelCoord cell, std::span<const LeafCrossing> crossings, glm::vec3 mean);

  FacetMap facets_;
};

}  // namespace scree
