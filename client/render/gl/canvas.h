// Targets to draw a picture into: many samples a pixel, averaged into one. Need the GL context current.
#pragma once

#include <optional>

#include "client/render/gl/gl.h"
#include "shared/base/result.h"

namespace scree {

/// A framebuffer of renderbuffers.
struct Canvas {
  gl::Framebuffer framebuffer;
  gl::Renderbuffer colour;
  gl::Renderbuffer depth;

  Canvas(int width, int height, int samples);
  bool complete() const;
};

class Canvases {
 public:
  /// Makes a canvas of that size; `samples` are at most as many as the driver has. Fails if it cannot make
  /// them so large. What is there already of the size stays.
  Result<void> prepare(int width, int height, int samples);

  /// Whether the last prepare() made them.
  bool ready() const { return one_.has_value(); }
  /// To be drawn into: many_ samples, or one. After prepare().
  unsigned drawn() const { return many_ ? many_->framebuffer.name() : one(); }
  /// One sample a pixel: where average() leaves the picture, and depths are drawn.
  unsigned one() const { return one_->framebuffer.name(); }
  void average() const;

 private:
  int width_ = 0;
  int height_ = 0;
  int samples_ = 0;  ///< as they were wanted
  std::optional<Canvas> many_;
  std::optional<Canvas> one_;
};

/// Copies a picture of one sample, stretched smoothly if the sizes differ.
void copy_picture(unsigned from, int from_width, int from_height, unsigned to, int width, int height);

}  // namespace scree
