// The solid whose surface is a mesh: distances to its triangles, signed by how often it winds around a place.
// Holes are closed by the surface on which it winds around by half.
#pragma once

#include "tools/import/mesh/mesh_bodies.h"
#include "tools/import/solid.h"

namespace scree {

/// `open`: the edges around its holes; none: the mesh is closed. Its insides are inside (mesh_parts.h). The
/// error says that it is beyond the world, or too large for voxels of that size.
Result<std::unique_ptr<Solid>> solid_of_mesh(TriangleMesh mesh, const std::vector<OpenBody::Edge>& open,
                                             float voxel_size_m);

}  // namespace scree
