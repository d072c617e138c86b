// The solid whose surface is a mesh: distances to its triangles, signed by how often it winds around a place.
// Holes are closed by the surface on which it winds around by half.
#pragma once

#include "tools/import/mesh/triangle_mesh.h"
#include "tools/import/solid.h"

namespace scree {

/// `closed`: the mesh has no open edge. It is one that turn_inside_in() went over. The error says that it is
/// beyond the world, or too large for voxels of that size.
Result<std::unique_ptr<Solid>> solid_of_mesh(TriangleMesh mesh, bool closed, float voxel_size_m);

}  // namespace scree
