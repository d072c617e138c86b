// Sharp edges for the polygons of surface nets: the vertices of cells through which an edge runs move to the
// point where the faces meet (Kobbelt et al. 2001, dual contouring by Ju et al. 2002), by the planes of
// face_plane.h. surface_nets itself stays as it is: its polygons are also the kernels'.
//
// Pure, safe from any thread. Units: voxels.
#pragma once

#include "shared/surface/surface_mesh.h"

namespace scree {

/// A vertex on an edge has a normal of this length, of 127: it belongs to several faces, so the shader takes
/// the triangle's normal instead.
inline constexpr int crease_normal_length = 63;

/// Voxels that a vertex may leave its cell by, to the tip of a thin wedge that fills no voxel.
inline constexpr int crease_reach = 2;

/// Moves vertices of a mesh of `surface_nets` over the window to the edges of its flat faces, splits quads
/// along edges, and gives the vertices beside an edge the normals of their faces. Afterwards a vertex may lie
/// outside its cell, but only in cells without a surface. Rounded rock stays as it is. The mesh's origin
/// becomes lower, by crease_reach.
///
/// A vertex's place depends only on the codes around its cell: meshes that share cells still meet. `fixed`,
/// if given, are the vertices of a mesh of leaves (leaf_surface.h) that are not of this window's cells: they
/// stay, and no polygon is split anew. `smooth`, if given, is the same box with rock that has no edges: where
/// a cell is as there, its vertex stays.
void sharpen_creases(const Window& window, SurfaceMesh& mesh, const std::vector<bool>* fixed = nullptr,
                     const Window* smooth = nullptr);

}  // namespace scree
