// Houses as closed meshes: walls with windows, floors and a roof, each part a closed box or prism of its own.
// The parts overlap, as in other people's files.
#pragma once

#include "tools/import/mesh/triangle_mesh.h"

namespace scree {

struct HousePlan {
  float x_m = 0.0F;  ///< of its corner with the least x and z
  float z_m = 0.0F;
  float width_m = 7.0F;  ///< along x
  float depth_m = 7.0F;  ///< along z
  int storeys = 2;       ///< of 3 m
  bool gable = false;    ///< else a flat roof with a parapet
};

/// It stands on y = 0 and reaches a metre below. Faces lie between voxels where lengths are multiples of
/// `voxel_m`.
TriangleMesh house(const HousePlan& plan, float voxel_m);

}  // namespace scree
