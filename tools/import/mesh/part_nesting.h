// Which parts of a mesh lie within which, and which way round each has to be. Internal to import/mesh.
#pragma once

#include "tools/import/mesh/mesh_parts.h"

namespace scree {

/// Turns parts whose inside is outside. One that lies within rock, and was the other way round than the part
/// around it, is a cavity and stays so.
void turn_insides_in(TriangleMesh& mesh, std::vector<MeshPart>& parts, PartFindings& found);

}  // namespace scree
