// Surfaces as files of triangles: PLY, OBJ and glTF.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "shared/base/result.h"
#include "shared/material/material.h"

namespace scree {

/// A closed surface: every edge is shared by two triangles.
struct WeldedSurface {
  /// In 1/surface_steps_per_voxel voxel.
  using Point = std::array<int32_t, 3>;

  std::vector<Point> points;
  std::vector<Material> materials;                 ///< one per point: of the rock beneath
  std::vector<std::array<uint32_t, 3>> triangles;  ///< counterclockwise from the air
};

/// Whether a file of that name can be written: .ply, .obj or .glb.
bool is_surface_name(const std::string& path);

/// Metres, y up. In glTF points have the colours of their materials, as they look when painted, so that it is
/// one closed mesh; PLY and OBJ have none. Returns the file's bytes. `step_m`: metres a unit of the points.
Result<uint64_t> write_surface(const WeldedSurface& surface, const std::string& path, float step_m);

}  // namespace scree
