// The uniforms of atmosphere.glsl, material.glsl, rock.glsl and shadow.glsl: one light for all methods.
#pragma once

#include "client/render/gl/gl.h"
#include "client/render/gl/surface_variants.h"
#include "client/render/scene/draw_method.h"

namespace scree {

/// The least that the shader of a surface must know to draw in that pass.
inline Surfaces surfaces(bool untouched, const DrawPass& pass) {
  if (untouched) return Surfaces::ground;
  return pass.lighting.images == 0 ? Surfaces::materials : Surfaces::images;
}

/// Sets the uniforms of the program in use. Binds the shadow map to that texture unit, and the
/// table of materials and their images to their own.
void set_lighting(const gl::Program& program, const DrawPass& pass, int shadow_unit);

}  // namespace scree
