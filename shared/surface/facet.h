// Flat faces of the rock, found from the codes around a lattice point. Dual contouring places its vertices by
// these planes. Pure, safe from any thread. Units: voxels.
#pragma once

#include <glm/vec3.hpp>

#include "shared/field/window.h"

namespace scree {

/// The plane n · x = offset, x from the lattice point; n of unit length, out of the rock.
struct Facet {
  glm::vec3 normal{0.0F};
  float offset = 0.0F;
  int supporters = 0;  ///< number of the 26 points around that agree with the plane; 0: there is no plane

  bool is_known() const { return supporters > 0; }
};

/// The facet of the face nearest to the point. Near an edge of the rock the differences to the two sides of
/// the point differ, and along each axis only one of them belongs to that face. This takes that one of the
/// eight choices with which most points around agree, fitted to these points. The window must hold the 26
/// points around, too.
Facet facet_at(const Window& window, VoxelCoord point);

}  // namespace scree
