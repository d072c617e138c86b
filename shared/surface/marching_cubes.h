// Marching cubes (Lorensen and Cline 1987; section 1.3 of the paper), the other way to make polygons of the
// zero level of codes: a vertex on every edge of the grid that the surface crosses, and in each cell the
// triangles of cube_cases.h. For the eye only.
//
// Cells share the vertices of their edges, and agree on every face; so every edge of the whole surface is
// shared by exactly two triangles, wherever one box ends and the next begins. Where leaves of an octree of
// different sizes meet, leaf_cubes closes the surface by the same loops of the leaves' divided boundaries
// (leaf_loops.h). Pure, safe from any thread. Units: voxels.
#pragma once

#include "shared/surface/cell_mask.h"
#include "shared/surface/leaf_surface.h"
#include "shared/surface/surface_mesh.h"

namespace scree {

/// Longest side along z of an owned box: rows of signs are words.
inline constexpr int marching_cubes_side_max = 63;

/// Meshes the cells whose lowest voxels are owned; of those, if there is a mask, which holds all of them, the
/// ones that count. `window` must cover owned.grown(surface_nets_apron). `before`, if given, has the window's
/// box: what the field was as generated.
SurfaceMesh marching_cubes(const Window& window, const VoxelBox& owned, const Window* before = nullptr,
                           const CellMask* mask = nullptr);

/// The loops of each of these leaves, filled. What lies about them must be known; vertices on undivided edges
/// are to the bit where marching_cubes has them.
LeafMesh leaf_cubes(const LeafGrid& grid, std::span<const Leaf> leaves);

}  // namespace scree
