// The looks of a palette's rows for shaders (client/shaders/material.glsl), as a texture. Needs the GL
// context current.
#pragma once

#include "client/render/gl/gl.h"
#include "client/render/gl/material_images.h"
#include "shared/material/palette.h"

namespace scree {

class MaterialTable {
 public:
  /// The unit that set_lighting() binds it to, apart from those of all methods.
  static constexpr int unit = 5;

  MaterialTable(const Palette& palette, const MaterialImages& images) { set(palette, images); }

  /// From now on. A row that the palette has not got looks as its first one.
  void set(const Palette& palette, const MaterialImages& images);
  unsigned texture() const { return texture_.name(); }

 private:
  gl::Texture texture_;
};

}  // namespace scree
