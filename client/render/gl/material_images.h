// The images of a palette's rows on the GPU: layers of one texture, with mipmaps. Needs the GL context
// current.
//
// Without images there is no texture, and no memory.
#pragma once

#include <map>
#include <optional>
#include <set>

#include "client/render/gl/gl.h"
#include "client/render/scene/material_texels.h"
#include "shared/material/palette.h"

namespace scree {

class MaterialImages {
 public:
  /// The unit that set_lighting() binds it to, apart from those of all methods.
  static constexpr int unit = 7;

  /// From now on. Images beyond limits::material_images_max, in the palette's order, have no layer.
  void set(const Palette& palette, const MaterialTexelSet& come);

  /// The layer of an image; −1: it has not come, or has no room.
  int layer_of(const std::optional<Digest>& image) const;
  /// 0 while none has come.
  unsigned texture() const { return filled_.empty() ? 0 : texture_->name(); }
  size_t bytes() const;

 private:
  void make_room(const Palette& palette);

  std::optional<gl::Texture> texture_;
  std::map<Digest, int> layers_;  ///< of the palette's images
  std::set<Digest> filled_;       ///< those that have come
};

}  // namespace scree
