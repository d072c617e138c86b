// The points of the grid as the GPU takes them (client/shaders/grid.vert): coordinates along the axes, and
// the blocks of 8³ cells that have something to show. Needs the GL context current.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "client/render/bricks/brick_world.h"
#include "client/render/gl/gl.h"
#include "client/render/grid/grid_shape.h"

namespace scree {

class GridPoints {
 public:
  GridPoints();

  /// Places the grid around the eye. Blocks outside the view, or without a surface, are left out.
  void place(const GridShape& shape, const BrickWorld& world, glm::vec3 eye_m, const Frustum& frustum);
  /// One point a cell.
  void draw() const;

  unsigned line_texture() const { return lines_texture_.name(); }
  size_t blocks() const { return blocks_.size(); }
  size_t gpu_bytes() const;

 private:
  /// One axis: its points, metres, and the level of detail that is read at each.
  struct Line {
    std::vector<int> voxels;
    std::vector<int> levels;
  };
  /// The lowest cell.
  using Block = std::array<int32_t, 3>;

  bool shows(const Block& block, const BrickWorld& world, const Frustum& frustum) const;
  void upload(const BrickWorld& world, glm::vec3 eye_m);

  gl::Texture lines_texture_;
  gl::Buffer block_buffer_;
  gl::VertexArray array_;
  std::array<Line, 3> lines_;
  std::vector<Block> blocks_;
};

}  // namespace scree
