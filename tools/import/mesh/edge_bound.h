// How fast winding numbers may change around the open edges of a mesh. Away from its triangles only these
// change them: the gradient is that of a current along the edges (Biot and Savart). Internal to import/mesh.
#pragma once

#include <cstdint>

#include "tools/import/mesh/mesh_bodies.h"

namespace scree {

class EdgeBound {
 public:
  explicit EdgeBound(const std::vector<OpenBody::Edge>& edges);

  /// The most by which a winding number changes in a metre, within a ball; 0 without edges, and infinite
  /// where an edge comes near.
  double most_per_m(const glm::dvec3& centre, double radius_m) const;

 private:
  struct Node {
    glm::dvec3 centre{};
    double radius = 0.0;
    double length = 0.0;    ///< of its edges together
    OpenBody::Edge edge{};  ///< of a leaf
    uint32_t right = 0;     ///< child; the left one is the next node; 0: a leaf
  };

  void build(std::vector<OpenBody::Edge>& edges, size_t first, size_t count);
  double sum(uint32_t at, const glm::dvec3& centre, double radius_m) const;

  std::vector<Node> nodes_;
};

}  // namespace scree
