// The vertices of dual contouring (Ju et al. 2002): the point of a cell that lies best on the planes at its
// crossings (face_plane.h). Where a crossing knows no plane, it says nothing.
//
// Not thread-safe: it caches planes. Units: voxels.
#pragma once

#include <span>

#include "shared/surface/cell_planes.h"
#include "shared/surface/leaf_surface.h"

namespace scree {

class DualVertices {
 public:
  /// The window must outlive it.
  explicit DualVertices(const Window& window) : faces_(window) {}

  /// The vertex of the sheet with these crossings of the cell, in sides of the cell from its lowest corner,
  /// in the cell. The window reaches two voxels down and three up from the cell's lowest corner.
  glm::vec3 place(VoxelCoord cell, std::span<const LeafCrossing> crossings);

 private:
  FaceMap faces_;
};

}  // namespace scree
