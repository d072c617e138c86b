// Marching cubes (Lorensen and Cline 1987; section 1.3 of the paper): polygons of the zero level of codes,
// with a vertex on every edge of the grid that the surface crosses, and in each cell the triangles of
// cube_cases.h. For drawing only.
//
// Cells share the vertices of their edges, and agree on every face; so every edge of the whole surface is
// shared by exactly two triangles, also between neighbouring boxes. Where leaves of an octree of different
// sizes meet, leaf_cubes closes the surface with the loops of the leaves' divided boundaries (leaf_loops.h).
// Pure, safe from any thread. Units: voxels.
#pragma once

#include "shared/surface/cell_mask.h"
#include "shared/surface/leaf_surface.h"
#include "shared/surface/surface_mesh.h"

namespace scree {

/// Longest side along z of an owned box: rows of signs are words.
inline constexpr int marching_cubes_side_max = 63;

/// Meshes the cells whose lowest voxels are owned; with a mask, whose box must hold all of these, only the
/// cells in the mask. `window` must cover owned.grown(surface_nets_apron). `before`, if given, has the
/// window's box and holds the field as generated.
SurfaceMesh marching_cubes(const Window& window, const VoxelBox& owned, const Window* before = nullptr,
                           const CellMask* mask = nullptr);

/// Fills the loops of each of these leaves with triangles. The leaves around them must be known. Vertices on
/// undivided edges have the same bits as those of marching_cubes.
LeafMesh leaf_cubes(const LeafGrid& grid, std::span<const Leaf> leaves);

}  // namespace scree
