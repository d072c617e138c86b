// How often a surface winds around a place: 1 inside a closed mesh, 0 outside, and in between where the mesh
// has holes (Jacobson et al. 2013). A tree whose far nodes count as one dipole makes it fast (Barill et al.
// 2018).
#pragma once

#include "tools/import/mesh/triangle_mesh.h"

namespace scree {

class WindingTree {
 public:
  explicit WindingTree(const TriangleMesh& mesh);

  double winding(const glm::dvec3& p) const;
  /// The number of the triangle nearest to p; the mesh has one.
  uint32_t nearest(const glm::dvec3& p) const;

 private:
  struct Node {
    glm::dvec3 centre{};  ///< of its area
    glm::dvec3 normal{};  ///< the sum of its triangles', each as long as the triangle's area
    double radius = 0.0;  ///< of all its corners around the centre
    uint32_t first = 0;   ///< of its triangles
    uint32_t count = 0;
    uint32_t right = 0;  ///< child; the left one is the next node; 0: a leaf
  };
  using Corners = std::array<glm::dvec3, 3>;

  void add_pieces(const Corners& t, int halvings, size_t pieces_max);
  uint32_t build(uint32_t first, uint32_t count);
  double winding(uint32_t node, const glm::dvec3& p) const;
  struct Nearest {
    double distance = 1e300;
    uint32_t triangle = 0;
  };
  void find_nearest(uint32_t node, const glm::dvec3& p, Nearest& best) const;

  std::vector<Corners> triangles_;  ///< or pieces of slender ones
  std::vector<uint32_t> numbers_;   ///< of the triangles in the mesh
  std::vector<Node> nodes_;
};

}  // namespace scree
