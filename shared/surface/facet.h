// Flat faces of the rock as the codes around a lattice point tell them: the planes that dual contouring's
// vertices are placed by. Pure, safe from any thread. Units: voxels.
#pragma once

#include <glm/vec3.hpp>

#include "shared/field/window.h"

namespace scree {

/// The plane n · x = offset, x from the lattice point; n of unit length, out of the rock.
struct Facet {
  glm::vec3 normal{0.0F};
  float offset = 0.0F;
  int supporters = 0;  ///< of the 26 points around, those where the plane is right; 0: there is no plane

  bool is_known() const { return supporters > 0; }
};

/// Of the face that the point is nearest to. Across an edge of the rock the differences to either side of the
/// point differ, and of each axis only one belongs to that face: of the eight ways to choose, the one that
/// most points around agree with, then fitted to these. The window holds the points around, too.
Facet facet_at(const Window& window, VoxelCoord point);

}  // namespace scree
