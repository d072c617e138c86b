// Surface nets: triangles of the zero level of a window of codes (Gibson 1998), for the eye, and for cutters
// and slices, which work on polygons (polygon_mesh.h, stamp_slices.h): deterministic.
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
/// box: what the field was as generated, so that fresh surfaces can be told from weathered ones. `mask`, if
/// given, says of all cells from owned.lo − 2 to owned.hi which are leaves of that size (leaf_surface.h):
/// only quads between four such are made, and no other takes part in telling sheets apart.
SurfaceMesh surface_nets(const Window& window, const VoxelBox& owned, const Window* before = nullptr,
                         const CellMask* mask = nullptr);

/// The same polygons, with vertices at other places: dual contouring of leaves of one size.
SurfaceMesh surface_nets_placed(const Window& window, const VoxelBox& owned, const Window* before,
                                const CellMask* mask, const SheetPlace& place);

/// Meshes a window outside of which all is air: a piece's volume.
SurfaceMesh surface_nets_closed(const Window& volume, const Window* before = nullptr);

}  // namespace scree
