// Surfaces as files of triangles: PLY, OBJ and glTF.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "shared/base/result.h"
#include "shared/material/palette.h"

namespace scree {

/// A closed surface: every edge is shared by two triangles.
struct WeldedSurface {
  /// In 1/surface_steps_per_voxel voxel.
  using Point = std::array<int32_t, 3>;

  std::vector<Point> points;
  std::vector<Material> materials;                 ///< one per point: of the rock beneath
  std::vector<std::array<uint32_t, 3>> triangles;  ///< counterclockwise from the air
};

/// Puts the triangles in order of the materials of their first corners.
void order_by_material(WeldedSurface& surface);

/// Whether a file of that name can be written: .ply, .obj or .glb.
bool is_surface_name(const std::string& path);

/// The file of the materials' colours that is written beside such a file: that of a .obj; else empty.
std::string materials_file_of(const std::string& path);

/// Metres, y up. glTF and OBJ have a material, with name and colour, for each row of the palette that is
/// used: a triangle is of that of its first corner. In glTF all materials share the points, so that it is one
/// closed mesh. PLY has none. `surface` is in order of materials. Returns the file's bytes. `step_m`: metres
/// a unit of the points.
Result<uint64_t> write_surface(const WeldedSurface& surface, const Palette& palette, const std::string& path,
                               float step_m);

}  // namespace scree
