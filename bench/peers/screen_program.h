// A shader over the whole picture, for peers that follow a ray for each pixel.
#pragma once

#include <memory>
#include <string>

#include "client/render/scene/draw_method.h"
#include "shared/base/result.h"

namespace scree::peers {

/// A program with a fragment shader that finds the pixel's ray in `v_direction` (from the eye, of any
/// length), and the pass in `u_eye`, `u_sun`, `u_reach_m` and `u_view_projection`. All calls need the GL
/// context current.
class ScreenProgram {
 public:
  /// `peer` is named in the error.
  static Result<std::unique_ptr<ScreenProgram>> link(const std::string& peer,
                                                     const std::string& fragment_text);
  ~ScreenProgram();
  ScreenProgram(const ScreenProgram&) = delete;
  ScreenProgram& operator=(const ScreenProgram&) = delete;

  /// Makes it current and sets the pass; then the caller's own uniforms follow, and draw().
  void use(const DrawPass& pass) const;
  int uniform(const char* name) const;
  void draw() const;

 private:
  explicit ScreenProgram(unsigned program);
  unsigned program_;
  unsigned array_ = 0;
};

}  // namespace scree::peers
