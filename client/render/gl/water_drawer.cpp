#include "client/render/gl/water_drawer.h"

#include <array>
#include <glm/matrix.hpp>

#include "client/render/gl/shader_sources.h"

namespace scree {

Result<void> WaterDrawer::set_level(WaterLevel level_m) {
  level_m_ = level_m;
  if (!level_m || program_) return {};
  program_.emplace(TRY(gl::Program::link(
      "water", std::array{shader_source("sky.vert")},
      std::array{shader_source("atmosphere.glsl"), shader_source("noise.glsl"), shader_source("clouds.glsl"),
                 shader_source("haze.glsl"), shader_source("water.frag")})));
  return {};
}

void WaterDrawer::draw(const DepthCopy& depths, const DrawPass& pass) const {
  if (!level_m_) return;
  program_->use();
  program_->set("u_inverse_view_projection", glm::inverse(pass.view_projection));
  program_->set("u_eye", pass.eye_m);
  program_->set("u_sun", pass.lighting.sun);
  program_->set("u_fog_m", pass.lighting.fog_m);
  program_->set("u_level", *level_m_);
  program_->set("u_time", pass.wind_s);
  program_->set("u_depth", 0);
  depths.bind(0);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glBindVertexArray(nothing_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthMask(GL_TRUE);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
}

}  // namespace scree
