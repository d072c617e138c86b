#include "client/render/gl/lighting.h"

#include "client/render/gl/material_table.h"

namespace scree {

void set_lighting(const gl::Program& program, const DrawPass& pass, int shadow_unit) {
  program.set("u_eye", pass.eye_m);
  program.set("u_sun", pass.lighting.sun);
  program.set("u_fog_m", pass.lighting.fog_m);
  program.set("u_ice_above_m", pass.lighting.layers.ice_above_m);
  program.set("u_bulk_tint", pass.lighting.tints.bulk);
  program.set("u_soil_tint", pass.lighting.tints.soil);
  program.set("u_cap_tint", pass.lighting.tints.cap);
  program.set("u_shadow_matrix", pass.lighting.shadow_matrix);
  program.set("u_shadow_map", shadow_unit);
  program.set("u_shadow_samples", pass.lighting.shadow_samples);
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(shadow_unit));
  glBindTexture(GL_TEXTURE_2D, pass.lighting.shadow_map);
  program.set("u_materials", MaterialTable::unit);
  glActiveTexture(GL_TEXTURE0 + MaterialTable::unit);
  glBindTexture(GL_TEXTURE_2D, pass.lighting.materials);
  program.set("u_images", MaterialImages::unit);
  if (pass.lighting.images != 0) {
    glActiveTexture(GL_TEXTURE0 + MaterialImages::unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, pass.lighting.images);
  }
  glActiveTexture(GL_TEXTURE0);
}

}  // namespace scree
