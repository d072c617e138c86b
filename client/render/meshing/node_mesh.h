// The mesh of one node of the forest (surface_forest.h). Polygons between cells of its own level are surface
// nets (surface_nets.h); where finer nodes touch it, those over the leaves of the octree join them
// (leaf_surface.h), whose polygons reach from level to level.
//
// A polygon between nodes belongs to the coarsest one; of several, to the one farthest along x, then y, then
// z. Points that finer nodes touch have the samples of those. So all meshes meet without a crack, to the bit.
// A job owns all its data: it may run on any thread.
#pragma once

#include <optional>

#include "client/render/levels/surface_levels.h"
#include "client/render/meshing/surface_forest.h"

namespace scree {

/// Surface nets, dual contouring, marching cubes.
enum class Polygoniser { nets, dual, cubes };

struct NodeJob {
  SurfaceNode node;
  Neighbours around{};
  Polygoniser polygoniser = Polygoniser::nets;
  FaceEdges edges = FaceEdges::sharp;  ///< of the finest level
  std::optional<BlockWindows> own;     ///< at the node's level; nothing: all air or all rock
  std::optional<BlockWindows> finer;   ///< one level below, where a finer node touches it
  bool own_is_rock = false;            ///< when there is no window
  bool finer_is_rock = false;
};

struct NodeMesh {
  SurfaceNode node;
  int level = 0;  ///< whose samples the mesh's units are
  SurfaceMesh mesh;
};

/// The node's samples, in those of its level.
VoxelBox samples_of(const SurfaceNode& node);

/// Copies the needed codes out of the field. Nothing if the node has no surface.
std::optional<NodeJob> gather_node(SurfaceLevels& levels, const Field& field, const SurfaceNode& node,
                                   const Neighbours& around, Polygoniser polygoniser,
                                   FaceEdges edges = FaceEdges::sharp);

NodeMesh mesh_node(const NodeJob& job);

}  // namespace scree
