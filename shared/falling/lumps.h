// Parts of a support search that hang together, as one mass: for sections that break by leverage
// (leverage.h). Private to this folder. Lengths in voxels.
#pragma once

#include <glm/vec3.hpp>

#include "shared/falling/support_parts.h"

namespace scree {

inline glm::dvec3 middle_of_voxel(VoxelCoord v) {
  return glm::dvec3(v.x, v.y, v.z);
}

inline int along(BrickCoord brick, int axis) {
  return axis == 0 ? brick.x : axis == 1 ? brick.y : brick.z;
}

/// A weight and where it is.
struct Mass {
  double kg = 0.0;
  glm::dvec3 moment{0.0};  ///< kg voxels

  void add(double more_kg, glm::dvec3 at) {
    kg += more_kg;
    moment += at * more_kg;
  }
  glm::dvec3 centre() const { return moment / kg; }
};

/// Parts that connect without crossing the plane that is looked at.
struct Lump {
  Mass mass;
  int64_t voxels = 0;
  size_t struck = 0;  ///< parts of it on which a blow falls
  bool held = false;
  bool changed = false;
  VoxelBox bounds;  ///< of its bricks

  void add(const Lump& other);
};

glm::dvec3 centre(const SupportPart& part);
/// Weight of so many of a part's voxels.
double kg(const SupportPart& part, int voxels, double voxel_m3);
Lump lump_of(const SupportPart& part, double voxel_m3);

}  // namespace scree
