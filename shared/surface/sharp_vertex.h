// The vertices of dual contouring (Ju et al. 2002): edges and corners of the rock stay sharp.
//
// Where the codes about a cell tell flat faces (rock_faces.h), and some of these, all convex or all concave,
// explain the codes, the vertex lies where they meet, if that is in the cell. They are held against codes on
// the side where the distance to such an edge is the largest of the planes', in rock, or the smallest, in
// air: on the other side it is rounded. So a cell that an edge runs through knows of both faces, even if one
// of them crosses no edge of the cell; cubes' edges are within 0.05 voxel. Elsewhere, least squares over the
// planes at the crossings.
//
// Not thread-safe: it remembers what it found. Units: voxels.
#pragma once

#include <span>

#include "shared/surface/leaf_surface.h"
#include "shared/surface/rock_faces.h"

namespace scree {

class SharpVertices {
 public:
  /// The window must outlive it.
  explicit SharpVertices(const Window& window) : facets_(window) {}

  /// For the sheet that crosses those edges of the cell, from whose lowest corner the window reaches two
  /// voxels down and three up. In sides of the cell from its lowest corner; may lie outside of the cell.
  glm::vec3 place(VoxelCoord cell, std::span<const LeafCrossing> crossings);

 private:
  glm::vec3 least_squares(VoxelCoord cell, std::span<const LeafCrossing> crossings, glm::vec3 mean);

  FacetMap facets_;
};

}  // namespace scree
