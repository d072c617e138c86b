// Edges of a mesh, and the triangles at them. Internal to import/mesh.
#pragma once

#include <span>

#include "tools/import/mesh/triangle_mesh.h"

namespace scree {

/// A triangle's use of an edge.
struct EdgeUse {
  uint32_t a;  ///< points, a < b
  uint32_t b;
  uint32_t triangle;
  bool forward;  ///< the triangle goes from a to b

  bool same_edge(const EdgeUse& other) const { return a == other.a && b == other.b; }
};

/// Sorted by edge, then by triangle.
std::vector<EdgeUse> edge_uses(const TriangleMesh& mesh);

/// Calls f(span of uses) for each edge.
template <typename F>
void for_each_edge(const std::vector<EdgeUse>& uses, F&& f) {
  for (size_t first = 0; first < uses.size();) {
    size_t end = first + 1;
    while (end < uses.size() && uses[end].same_edge(uses[first])) ++end;
    f(std::span<const EdgeUse>(uses).subspan(first, end - first));
    first = end;
  }
}

/// Those that one triangle alone uses.
std::vector<EdgeUse> border_edges(const std::vector<EdgeUse>& uses);

/// Triangles in the one direction less those in the other: 0 where the surface is closed.
int balance_of(std::span<const EdgeUse> uses);

void retain_triangles(TriangleMesh& mesh, const std::vector<bool>& stays);

}  // namespace scree
