// Draws what stands about (detail_field.h) by instances: one draw a kind, into depth, in the light that all
// methods share. Needs the GL context current, the destructor too.
#pragma once

#include <array>
#include <optional>

#include "client/render/details/detail.h"
#include "client/render/gl/gl.h"
#include "client/render/scene/draw_method.h"

namespace scree {

class DetailDrawer {
 public:
  /// Fails when a shader does.
  static Result<DetailDrawer> create();

  /// Details whose range ends at `range_m` shrink to nothing before it. For the shadow map only depth counts.
  void draw(const DetailLists& lists, float range_m, const DrawPass& pass) const;

 private:
  struct Shape {
    gl::VertexArray array;
    gl::Buffer vertices, corners, instances;
    GLsizei corner_count = 0;
  };
  /// By whether they draw stones, or plants.
  using Programs = std::array<gl::Program, 2>;
  DetailDrawer(Programs&& colour, Programs&& shadow);

  Programs colour_, shadow_;
  std::array<Shape, detail_kinds> shapes_;
};

}  // namespace scree
