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

#include "shared/field/surface_mesh.h"

namespace scree {

/// Meshes `owned`; `window` must cover owned.grown(surface_nets_apron). `before`, if given, has the window's
/// box: what the field was as generated, so that fresh surfaces can be told from weathered ones.
SurfaceMesh surface_nets(const Window& window, const VoxelBox& owned, const Window* before = nullptr);

/// Meshes a window outside of which all is air: a piece's volume.
SurfaceMesh surface_nets_closed(const Window& volume, const Window* before = nullptr);

}  // namespace scree
