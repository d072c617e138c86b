#include "client/render/gl/surface_program.h"

#include <array>
#include <span>
#include <utility>

#include "client/render/gl/shader_sources.h"

namespace scree {

Result<SurfaceProgram> link_surface_program(std::string_view name, std::span<const std::string_view> fragment,
                                            bool pieces) {
  const std::array vertex{std::string_view(pieces ? "#define PIECES 1\n" : ""), shader_source("pieces.glsl"),
                          shader_source("rotation.glsl"), shader_source("surface.vert")};
  Result<gl::Program> program = gl::Program::link(name, vertex, fragment);
  if (!program) return fail(program.error().message);
  return SurfaceProgram(std::move(*program));
}

SurfaceProgram::SurfaceProgram(gl::Program&& linked)
    : program(std::move(linked)),
      step(program.uniform("u_step")),
      origin(program.uniform("u_origin")),
      voxel_m(program.uniform("u_voxel_m")),
      loose(program.uniform("u_loose")) {
  program.use();
  program.set("u_pieces", pieces_unit);
}

void SurfaceProgram::set_place(const MeshPlace& place) const {
  glUniform3f(origin, place.origin.x, place.origin.y, place.origin.z);
  glUniform1f(step, place.step);
}

std::vector<std::string_view> surface_fragment_parts(Surfaces surfaces) {
  return {define_of(surfaces),          shader_source("rotation.glsl"), shader_source("atmosphere.glsl"),
          shader_source("noise.glsl"),  shader_source("clouds.glsl"),   shader_source("haze.glsl"),
          shader_source("stones.glsl"), shader_source("material.glsl"), shader_source("rock.glsl"),
          shader_source("shadow.glsl"), shader_source("shape.glsl"),    shader_source("surface.frag")};
}

Result<SurfaceProgram> link_surface(Surfaces surfaces) {
  return link_surface_program("surface", surface_fragment_parts(surfaces), surfaces != Surfaces::ground);
}

Result<SurfaceProgram> link_surface_shadow() {
  return link_surface_program("surface_shadow", std::array{shader_source("surface_shadow.frag")});
}

}  // namespace scree
