#include "client/render/gl/lighting.h"

namespace scree {

void set_lighting(const gl::Program& program, const DrawPass& pass, int shadow_unit) {
  program.set("u_eye", pass.eye_m);
  program.set("u_sun", pass.lighting.sun);
  program.set("u_fog_m", pass.lighting.fog_m);
  const MaterialHeights& layers = pass.lighting.layers;
  program.set("u_ice_above_m", layers.ice_above_m);
  program.set("u_soil_below_m", layers.soil_below_m);
  program.set("u_layers", glm::vec4(layers.soil_below_m, traits_of(material::soil).layer_depth_m,
                                    layers.ice_above_m, traits_of(material::ice).layer_depth_m));
  program.set("u_shadow_matrix", pass.lighting.shadow_matrix);
  program.set("u_shadow_map", shadow_unit);
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(shadow_unit));
  glBindTexture(GL_TEXTURE_2D, pass.lighting.shadow_map);
  glActiveTexture(GL_TEXTURE0);
}

}  // namespace scree
