// The programs that draw meshes of surfaces (gpu_mesh.h): blocks of terrain and pieces. Need the GL context
// current.
#pragma once

#include <string_view>
#include <vector>

#include "client/render/gl/gl.h"
#include "client/render/gl/surface_variants.h"
#include "client/render/scene/mesh_place.h"

namespace scree {

/// The uniforms of surface.vert that differ from mesh to mesh, looked up once.
struct SurfaceProgram {
  gl::Program program;
  GLint step, origin, voxel_m, centre_m, place_m, rotation, loose, tint;

  explicit SurfaceProgram(gl::Program&& linked);
  void set_place(const MeshPlace& place) const;
};

/// In colour, and for the shadow map. Fail when a shader does.
Result<SurfaceProgram> link_surface(Surfaces surfaces);
Result<SurfaceProgram> link_surface_shadow();

/// The shader parts that shade every surface of polygons.
std::vector<std::string_view> surface_fragment_parts(Surfaces surfaces);

}  // namespace scree
