// The programs that draw meshes of surfaces (mesh_arena.h): blocks of terrain and pieces. Need the GL context
// current.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "client/render/gl/gl.h"
#include "client/render/gl/surface_variants.h"
#include "client/render/scene/mesh_place.h"

namespace scree {

/// The uniforms of surface.vert that differ from draw to draw, looked up once.
struct SurfaceProgram {
  /// Texture unit of the pieces' places (client/render/pieces/piece_views.h).
  static constexpr int pieces_unit = 2;

  gl::Program program;
  GLint step, origin, voxel_m, loose;

  explicit SurfaceProgram(gl::Program&& linked);
  void set_place(const MeshPlace& place) const;
};

/// In colour, and for the shadow map. Fail when a shader does.
Result<SurfaceProgram> link_surface(Surfaces surfaces);
Result<SurfaceProgram> link_surface_shadow();

/// With these parts of a fragment shader. Without pieces, it draws terrain alone, which costs less.
Result<SurfaceProgram> link_surface_program(std::string_view name, std::span<const std::string_view> fragment,
                                            bool pieces = true);

/// The shader parts that shade every surface of polygons.
std::vector<std::string_view> surface_fragment_parts(Surfaces surfaces);

}  // namespace scree
