// Meshes from files of OBJ, PLY, STL, glTF and what else assimp reads.
#pragma once

#include "shared/base/result.h"
#include "tools/import/mesh/triangle_mesh.h"
#include "tools/import/placement.h"

namespace scree {

/// Each mesh by itself, welded, at its place in the world. The error says what is wrong with the file.
Result<std::vector<TriangleMesh>> read_meshes(const std::string& path, const Placement& place);

}  // namespace scree
