#include "client/render/gl/sky_drawer.h"

#include <array>
#include <glm/matrix.hpp>

#include "client/render/gl/shader_sources.h"

namespace scree {

Result<SkyDrawer> SkyDrawer::create() {
  Result<gl::Program> program =
      gl::Program::link("sky", std::array{shader_source("sky.vert")},
                        std::array{shader_source("atmosphere.glsl"), shader_source("noise.glsl"),
                                   shader_source("clouds.glsl"), shader_source("sky.frag")});
  if (!program) return fail(program.error().message);
  return SkyDrawer(std::move(*program));
}

void SkyDrawer::draw(const DrawPass& pass) const {
  program_.use();
  program_.set("u_inverse_view_projection", glm::inverse(pass.view_projection));
  program_.set("u_eye", pass.eye_m);
  program_.set("u_sun", pass.lighting.sun);
  glDepthFunc(GL_LEQUAL);
  glBindVertexArray(nothing_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_LESS);
}

}  // namespace scree
