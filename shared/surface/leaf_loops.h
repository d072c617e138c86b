// The loops in which the surface crosses the boundary of one leaf of an octree, for leaf_surface and
// marching_cubes. Pure, safe from any thread. Units: sides of the smallest leaf.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shared/surface/leaf_surface.h"

namespace scree {

/// An edge between two neighbouring points of a divided boundary, from its lower end.
struct LeafEdge {
  VoxelCoord from;
  int axis = 0;
  int length = 1;

  auto operator<=>(const LeafEdge&) const = default;
  VoxelCoord to() const;
};

/// Two crossed edges that a sheet joins across a face.
struct LeafLink {
  LeafEdge a;
  LeafEdge b;
};

/// Number of edges that a leaf can have: its boundary lies on a lattice of 3³ points.
inline constexpr size_t leaf_edge_ids = 162;
/// Index of one of the leaf's edges, below leaf_edge_ids.
size_t id_in(const Leaf& leaf, const LeafEdge& edge);

struct LeafLoops {
  int sheets = 0;
  std::array<uint8_t, leaf_edge_ids> sheet_of;  ///< by id_in; 255 where the edge is not crossed
  std::vector<LeafEdge> crossed;

  int sheet(const Leaf& leaf, const LeafEdge& edge) const { return sheet_of[id_in(leaf, edge)]; }
};

/// Whether runs of rock or runs of air are cut off, each on its own.
enum class LeafRuns { rock, air };
LeafLoops trace_loops(const LeafGrid& grid, const Leaf& leaf, LeafRuns runs);

/// The loops that cut off rock, each as its edges in order, counter-clockwise seen from the air.
std::vector<std::vector<LeafEdge>> cycles_of(const LeafGrid& grid, const Leaf& leaf);

/// Whether no smaller leaf touches this one, not even by a corner.
bool is_undivided(const LeafGrid& grid, const Leaf& leaf);

/// The first face on which both links belong to one sheet (CellCase::pinched_face); -1 if there is none.
int pinched_face(const LeafGrid& grid, const Leaf& leaf, const LeafLoops& loops);

/// The links across the undivided face 2·axis + side.
std::vector<LeafLink> links_of_face(const LeafGrid& grid, const Leaf& leaf, int face);

/// The place on a crossed edge where the sign changes, from its start, 0..1.
float crossing_of(const LeafGrid& grid, const LeafEdge& edge);
bool is_crossed(const LeafGrid& grid, const LeafEdge& edge);

}  // namespace scree
