// Borders of a mesh that run along each other without sharing points: where a wall has a corner that its
// neighbour lacks, or where rounding tore a seam. Internal to import/mesh.
#pragma once

#include "tools/import/mesh/mesh_edges.h"

namespace scree {

struct BorderPair {
  uint32_t one;  ///< triangles
  uint32_t other;
  bool agree;  ///< their borders run in opposite directions, as neighbours' do
};

struct BorderMatch {
  std::vector<BorderPair> pairs;
  std::vector<bool> joined;  ///< by border edge: another border runs along all of it
};

/// `tolerance_m`: how far borders may lie from each other.
BorderMatch match_borders(const TriangleMesh& mesh, const std::vector<EdgeUse>& border, double tolerance_m);

}  // namespace scree
