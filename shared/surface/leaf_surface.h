// The surface over the leaf cells of an octree, closed where leaves of different sizes meet: dual
// contouring's walk over edges (Ju et al. 2002), with a vertex for each sheet of surface in a leaf (Nielson
// 2004).
//
// Leaves that touch, even by a corner, differ in size by at most a factor of two. The boundary of a leaf is
// divided where smaller leaves touch it. On each of the resulting polygons, crossed edges are linked so that
// each run of rock is cut off on its own. Both leaves at a polygon make the same links, so the loops of links
// close from leaf to leaf, and the dual of that surface (a vertex a loop, a polygon a crossed edge) has two
// polygons at every edge. Where two leaves share two links between the same two loops, undivided leaves of
// one size cut off runs of air instead, as surface_nets does; between others a vertex on the face separates
// the two. Pure, safe from any thread. Units: sides of the smallest possible leaf.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/field/window.h"

namespace scree {

/// The side of cells whose leaf is not known. Edges beside such cells get no polygon.
inline constexpr uint8_t leaf_unknown = 0;

/// A leaf of an octree: a cube.
struct Leaf {
  VoxelCoord at;  ///< its lowest point, a multiple of its side
  int side = 1;   ///< a power of two

  bool operator==(const Leaf&) const = default;
};

/// A part of an octree.
struct LeafGrid {
  VoxelBox cells;              ///< of side 1
  std::vector<uint8_t> sides;  ///< of the leaf that holds the cell, a power of two, in a window's order
  /// Distances, in any unit, at the points of `cells` and one more at the upper ends; negative in rock. Only
  /// the values at corners of leaves matter. Leaves are skipped fastest where the other points have the sign
  /// of the corners around them.
  std::vector<float> distances;

  explicit LeafGrid(const VoxelBox& box);
  float& distance_at(VoxelCoord p) { return distances[point_index(p)]; }
  float distance_at(VoxelCoord p) const { return distances[point_index(p)]; }
  uint8_t& side_at(VoxelCoord cell) { return sides[index(cell)]; }
  uint8_t side_at(VoxelCoord cell) const { return cells.holds(cell) ? sides[index(cell)] : leaf_unknown; }
  /// The leaf that holds the cell, which must be known.
  Leaf leaf_at(VoxelCoord cell) const;

 private:
  size_t index(VoxelCoord cell) const;
  size_t point_index(VoxelCoord p) const;
};

/// A crossing of the surface with an edge of a leaf.
struct LeafCrossing {
  glm::vec3 at;  ///< 0..1, in sides of the leaf from its lowest corner
  int axis = 0;
};

/// The decisions of the caller.
class LeafRules {
 public:
  virtual ~LeafRules() = default;
  /// Whether to make the polygon of the edge between these three or four leaves.
  virtual bool owns(std::span<const Leaf> around) const = 0;
  /// The vertex of the sheet with these crossings, in sides of the leaf from its lowest corner; a vertex
  /// outside the leaf is moved into it.
  virtual glm::vec3 place(const Leaf& leaf, std::span<const LeafCrossing> crossings) const = 0;
};

struct LeafPoint {
  Leaf leaf;                       ///< a leaf that holds the point, or as much of one as its edge is long
  std::array<int32_t, 3> steps{};  ///< surface_steps_per_voxel to a side of 1, from the grid's origin
};

struct LeafMesh {
  std::vector<LeafPoint> points;
  std::vector<uint32_t> indices;  ///< triangles, counter-clockwise seen from the air
};

/// The polygons of all owned edges of these leaves, each once.
LeafMesh leaf_surface(const LeafGrid& grid, std::span<const Leaf> leaves, const LeafRules& rules);

/// The mean of the crossings, at least one: the rule of surface nets, in an undivided leaf with the same bits
/// as surface_nets.
glm::vec3 mean_of(std::span<const LeafCrossing> crossings);

}  // namespace scree
