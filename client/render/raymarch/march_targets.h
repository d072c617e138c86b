// The raymarcher's targets: at its own resolution what rays meet, colour and depth, and tiles with the
// distance at which rays may start. Needs the GL context current.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>

#include "client/render/gl/gl.h"

namespace scree {

class MarchTargets {
 public:
  /// Pixels along a side of a tile.
  static constexpr int tile = 8;

  MarchTargets();
  /// Does nothing if that is the size already.
  void resize(glm::ivec2 size);

  glm::ivec2 size() const { return size_; }
  glm::ivec2 tiles() const { return (size_ + tile - 1) / tile; }
  /// Binds a framebuffer and sets the viewport to its size.
  void draw_tiles() const;
  void draw_pieces() const;
  void draw_hits() const;
  void draw_pixels() const;

  unsigned tile_texture() const { return start_.name(); }
  unsigned hits_texture() const { return hits_.name(); }
  unsigned colour_texture() const { return colour_.name(); }
  unsigned depth_texture() const { return depth_.name(); }
  size_t bytes() const;

 private:
  glm::ivec2 size_{0};
  gl::Texture start_;
  gl::Texture hits_;
  gl::Texture colour_;
  gl::Texture depth_;
  gl::Framebuffer tiles_;
  gl::Framebuffer pieces_;   ///< hits and depths
  gl::Framebuffer marched_;  ///< hits alone: rays read the depths of pieces
  gl::Framebuffer pixels_;
};

}  // namespace scree
