// The uniforms of atmosphere.glsl, material.glsl, rock.glsl and shadow.glsl: one light for all methods.
#pragma once

#include "client/render/gl/gl.h"
#include "client/render/scene/draw_method.h"

namespace scree {

/// Sets the uniforms of the program in use. Binds the shadow map to that texture unit, and the
/// table of materials to its own.
void set_lighting(const gl::Program& program, const DrawPass& pass, int shadow_unit);

}  // namespace scree
