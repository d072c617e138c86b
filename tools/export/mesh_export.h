// A world's surface as triangles: the meshes that viewers draw, welded, and closed where the box ends.
#pragma once

#include <functional>
#include <string>

#include "shared/material/palette.h"
#include "tools/export/exported.h"

namespace scree {

struct MeshExported {
  uint64_t points = 0;
  uint64_t triangles = 0;
  uint64_t bytes = 0;      ///< of the file
  double volume_m3 = 0.0;  ///< of the mesh
};

/// `path`: an is_surface_name(). All of the mesh lies in memory. `progress(part)`: from 0 to 1.
Result<MeshExported> export_mesh(Field& field, const Palette& palette, const ChunkBox& box,
                                 const std::string& path, const std::function<void(double)>& progress);

}  // namespace scree
