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
  static constexpr double none = 1e300;
  /// The triangle nearest to a place, and how far it is; `none` away: there is no such triangle.
  struct Nearest {
    double distance = none;
    uint32_t triangle = 0;
    bool is_behind = false;  ///< the place lies on the triangle's inner side
  };
  /// The mesh has a triangle.
  Nearest nearest(const glm::dvec3& p) const;
  /// The triangle whose part of the mesh has the place: within the mesh, the nearest one that the place lies
  /// behind. Where two parts touch, each has a triangle at the same distance.
  uint32_t owner(const glm::dvec3& p) const;
  /// Whether f(triangle) is true of each triangle within reach of p, and of some more; it ends with the first
  /// of which it is not.
  template <typename F>
  bool all_near(const glm::dvec3& p, double reach, F&& f) const {
    return nodes_.empty() || all_near(0, p, reach, f);
  }

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
  bool reaches(const Node& node, const glm::dvec3& p, double reach) const;
  template <typename F>
  bool all_near(uint32_t at, const glm::dvec3& p, double reach, F& f) const {
    const Node& node = nodes_[at];
    if (!reaches(node, p, reach)) return true;
    if (node.right != 0) return all_near(at + 1, p, reach, f) && all_near(node.right, p, reach, f);
    for (uint32_t i = node.first; i < node.first + node.count; ++i)
      if (!f(numbers_[i])) return false;
    return true;
  }
  enum class Side : uint8_t { any, behind };
  void find_nearest(uint32_t node, const glm::dvec3& p, Side side, Nearest& best) const;

  std::vector<Corners> triangles_;  ///< or pieces of slender ones
  std::vector<uint32_t> numbers_;   ///< of the triangles in the mesh
  std::vector<Node> nodes_;
};

}  // namespace scree
