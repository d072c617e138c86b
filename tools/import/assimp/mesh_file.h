// Meshes from files of OBJ, PLY, STL, glTF and the other forms that assimp reads. It reads them in a process
// of its own (reader_process.h).
#pragma once

#include <set>

#include "shared/base/result.h"
#include "tools/import/colour_rows.h"
#include "tools/import/mesh/triangle_mesh.h"
#include "tools/import/placement.h"
#include "tools/import/process/reader_process.h"

namespace scree {

struct MeshFile {
  /// All of the file's meshes together, each at its place in the world; not welded.
  TriangleMesh mesh;
  uint64_t meshes = 0;  ///< that have triangles
  /// Materials that are none of the palette's: their names, and the triangles of each as its weight.
  struct Foreign {
    FileColour colour;
    bool has_colour = false;
  };
  std::vector<Foreign> foreign{};
  /// For each triangle 1 + the number of its foreign material; 0: it has none, or one of the palette's.
  std::vector<uint16_t> foreign_of{};
  uint64_t unread_textures = 0;         ///< pictures of materials that are not there, or are none
  std::set<std::string> map_used{};     ///< names of `named` that triangles have
  std::vector<std::string> warnings{};  ///< of assimp, on faces and points
  std::string missing_materials{};      ///< a file of materials that it names, and that is not there
  double metres_a_unit = 0.0;           ///< by the file; 0: it does not say
  bool says_up = false;                 ///< the file's form, or the file, says which axis is up
  double step_m = 0.0;                  ///< coarsest rounding of its coordinates, as they are read
};

/// `named`: the names that stand for rows of the palette. The error names the file and says what is wrong
/// with it.
Result<MeshFile> read_meshes(const std::string& path, const Placement& place, const ReaderLimits& bounds,
                             const MaterialMap& named = {});

}  // namespace scree
