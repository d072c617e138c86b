// Surface nets: triangles of the zero level of a window of codes (Gibson 1998), for drawing and for the
// kernels that work on polygons (polygon_mesh.h, stamp_slices.h). Deterministic.
//
// A cell is the cube between 8 voxels; each sheet of surface in it gets one vertex, at the mean of the
// crossings of its edges, and each grid edge that the surface crosses gets one quad. Where a cell holds
// several sheets it gets several vertices (Nielson 2004, "Dual Marching Cubes"; Wenger 2013, 3.4, for the
// faces that two cells would pinch), so every edge of the whole surface is shared by exactly two triangles.
//
// Seams: a box owns the quads of the grid edges whose lower voxel lies in it. Neighbouring boxes compute the
// vertices of shared cells from the same codes, bit for bit, so their meshes meet without a crack.
// Pure, safe from any thread. Units: voxels.
#pragma once

#include "shared/surface/cell_mask.h"
#include "shared/surface/placed_sheets.h"
#include "shared/surface/surface_mesh.h"

namespace scree {

/// Meshes `owned`; `window` must cover owned.grown(surface_nets_apron). `before`, if given, has the window's
/// box and holds the field as generated, so that fresh surfaces can be distinguished from weathered ones.
/// `mask`, if given, tells for all cells from owned.lo − 2 to owned.hi whether they are leaves of that size
/// (leaf_surface.h): only quads between four such cells are made, and other cells do not affect how sheets
/// are separated.
SurfaceMesh surface_nets(const Window& window, const VoxelBox& owned, const Window* before = nullptr,
                         const CellMask* mask = nullptr);

/// The same polygons, with vertices at other places: dual contouring of leaves of one size.
SurfaceMesh surface_nets_placed(const Window& window, const VoxelBox& owned, const Window* before,
                                const CellMask* mask, const SheetPlace& place);

/// Meshes a piece's volume: a window outside which everything is air. The mesh is closed.
SurfaceMesh surface_nets_closed(const Window& volume);
/// The box that surface_nets() has to own for that, and a volume's codes in the window that it then needs.
VoxelBox closed_box(const Window& volume);
Window closed_window(const Window& volume);

}  // namespace scree
