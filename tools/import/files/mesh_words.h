// Sentences on a mesh that was read: what was found, what was repaired, and what was assumed. Internal to
// import/files.
#pragma once

#include "tools/import/assimp/mesh_file.h"
#include "tools/import/files/solid_files.h"
#include "tools/import/mesh/mesh_bodies.h"

namespace scree {

/// `materials`: words on these, which end a sentence.
std::vector<std::string> words_on(const MeshFile& file, const MeshBodies& bodies, const SolidsImport& how,
                                  const std::string& materials);

}  // namespace scree
