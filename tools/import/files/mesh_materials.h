// The materials of a mesh's file: rows of the palette, by name or by colour. Internal to import/files.
#pragma once

#include "tools/import/assimp/mesh_file.h"
#include "tools/import/files/solid_files.h"

namespace scree {

/// The names that stand for rows: those of the palette, and those of --material-map, which go first.
MaterialMap names_of(const Palette& palette, const MaterialMap& map);

/// Gives each triangle a row. Materials that are none of the palette's become new ones of their colours,
/// unless there is one for all such (SolidsImport::material). Returns words on all of them, which may be
/// empty.
Result<std::string> give_materials(MeshFile& file, const SolidsImport& how, ImportPalette& palette);

}  // namespace scree
