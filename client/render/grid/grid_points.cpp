#include "client/render/grid/grid_points.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>

namespace scree {
namespace {

constexpr GLsizei points_per_block = grid_block * grid_block * grid_block;

/// At each point the level with two voxels to the coarser of the spacings beside it, as far as there is one:
/// distances saturate at three voxels, more than the ends of a crossed edge can have.
std::vector<int> levels_of(const std::vector<int>& points) {
  std::vector<int> levels(points.size());
  const auto spacing_after = [&](size_t i) { return static_cast<unsigned>(points[i + 1] - points[i]); };
  for (size_t i = 0; i < points.size(); ++i) {
    const unsigned after = i + 1 < points.size() ? spacing_after(i) : 1U;
    const unsigned before = i > 0 ? spacing_after(i - 1) : 1U;
    levels[i] = std::max(static_cast<int>(std::bit_width(std::max(before, after))) - 2, 0);
  }
  return levels;
}

}  // namespace

GridPoints::GridPoints() {
  glBindTexture(GL_TEXTURE_2D, lines_texture_.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, block_buffer_.name());
  glVertexAttribIPointer(0, 3, GL_INT, sizeof(Block), nullptr);
  glVertexAttribDivisor(0, 1);
  glEnableVertexAttribArray(0);
  glBindVertexArray(0);
}

void GridPoints::place(const GridShape& shape, const BrickWorld& world, glm::vec3 eye_m,
                       const Frustum& frustum) {
  for (int axis = 0; axis < 3; ++axis) {
    Line& line = lines_[static_cast<size_t>(axis)];
    line.voxels = grid_line(shape, eye_m[axis] / world.voxel_m());
    line.levels = levels_of(line.voxels);
  }
  blocks_.clear();
  for (int x = 0; x < shape.resolution; x += grid_block)
    for (int y = 0; y < shape.resolution; y += grid_block)
      for (int z = 0; z < shape.resolution; z += grid_block)
        if (const Block block{x, y, z}; shows(block, world, frustum)) blocks_.push_back(block);
  upload(world, eye_m);
}

bool GridPoints::shows(const Block& block, const BrickWorld& world, const Frustum& frustum) const {
  glm::vec3 lo_m, hi_m;
  int finest = 0, coarsest = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const Line& line = lines_[axis];
    const auto first = static_cast<size_t>(block[axis]);
    lo_m[static_cast<int>(axis)] = static_cast<float>(line.voxels[first]) * world.voxel_m();
    hi_m[static_cast<int>(axis)] = static_cast<float>(line.voxels[first + grid_block]) * world.voxel_m();
    // A corner is read at the coarsest level of its three coordinates.
    const auto begin = line.levels.begin() + static_cast<ptrdiff_t>(first);
    const auto [least, most] = std::minmax_element(begin, begin + grid_block + 1);
    finest = std::max(finest, *least);
    coarsest = std::max(coarsest, *most);
  }
  if (!frustum.touches((lo_m + hi_m) * 0.5F, glm::length(hi_m - lo_m) * 0.5F)) return false;
  const auto plain = world.plain(lo_m, hi_m, finest);
  if (!plain) return true;
  for (int level = finest + 1; level <= coarsest; ++level)
    if (world.plain(lo_m, hi_m, level) != plain) return true;
  return false;
}

void GridPoints::upload(const BrickWorld& world, glm::vec3 eye_m) {
  std::vector<float> texels;
  for (int axis = 0; axis < 3; ++axis) {
    const Line& line = lines_[static_cast<size_t>(axis)];
    for (size_t i = 0; i < line.voxels.size(); ++i) {
      const double at_m = static_cast<double>(line.voxels[i]) * static_cast<double>(world.voxel_m());
      texels.push_back(static_cast<float>(at_m - static_cast<double>(eye_m[axis])));
      texels.push_back(static_cast<float>(line.levels[i]));
    }
  }
  glBindTexture(GL_TEXTURE_2D, lines_texture_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RG32F, static_cast<GLsizei>(lines_[0].voxels.size()), 3, 0, GL_RG,
               GL_FLOAT, texels.data());
  glBindBuffer(GL_ARRAY_BUFFER, block_buffer_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(blocks_.size() * sizeof(Block)), blocks_.data(),
               GL_STREAM_DRAW);
}

void GridPoints::draw() const {
  if (blocks_.empty()) return;
  glBindVertexArray(array_.name());
  glDrawArraysInstanced(GL_POINTS, 0, points_per_block, static_cast<GLsizei>(blocks_.size()));
  glBindVertexArray(0);
}

size_t GridPoints::gpu_bytes() const {
  return lines_[0].voxels.size() * 3 * 2 * sizeof(float) + blocks_.size() * sizeof(Block);
}

}  // namespace scree
