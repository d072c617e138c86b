// Surfaces that show both sides, each as triangles of its own. Internal to import/mesh.
#pragma once

#include "tools/import/mesh/triangle_mesh.h"

namespace scree {

/// A triangle's corners, the least first, and in an order that both of its sides share.
struct Corners {
  TriangleMesh::Triangle sorted;
  bool odd;  ///< the other side
  uint32_t index;
};

Corners corners_of(TriangleMesh::Triangle t, uint32_t index);

/// Two sides cancel each other and go, unless a whole connected part has two: one of them is left. Returns
/// how many second sides of whole parts were left out.
size_t resolve_two_sides(TriangleMesh& mesh);

}  // namespace scree
