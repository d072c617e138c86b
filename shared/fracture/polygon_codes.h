// Codes from polygons: distances to them, and the voxels inside. Voxels; deterministic.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/field/window.h"
#include "shared/fracture/polygon_mesh.h"

namespace scree {

/// Squared distances of the voxels of a box to polygons, exact within the band of ±3 voxels.
class PolygonDistances {
 public:
  explicit PolygonDistances(const VoxelBox& box);
  void add(const PolygonMesh& mesh, const PolygonFace& face);
  /// Codes: negative where `inside` (a byte a voxel of the box) is not zero.
  Window codes(const std::vector<uint8_t>& inside) const;

 private:
  struct Side {
    glm::dvec3 from, along;
    double inverse2 = 0.0;  ///< 1 / squared length; 0 of a point
    double from_u = 0.0, from_v = 0.0, to_u = 0.0, to_v = 0.0;
  };
  struct Span {
    int lo = 0, hi = 0;  ///< hi beyond the last
  };

  double squared_distance(glm::dvec3 p, const Plane& plane, double above, int u, int v) const;
  static Span span(double lo, double hi, int box_lo, int box_hi);

  VoxelBox box_;
  std::vector<double> squared_;
  std::vector<Side> sides_;
};

/// Sets the bytes of the voxels within a closed mesh, by the winding number along z.
void mark_inside(const PolygonMesh& mesh, const VoxelBox& box, std::vector<uint8_t>& inside);

/// The box of voxels that holds the bounds and `margin` voxels more, cut to `within`.
VoxelBox voxels_around(const PolygonBounds& bounds, int margin, const VoxelBox& within);

}  // namespace scree
